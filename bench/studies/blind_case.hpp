// SPDX-License-Identifier: MIT
// Draws the cases of a blind suite at random.
#pragma once
#include <array>
#include <map>

#include "known_effects.hpp"
#include "signal_law.hpp"

namespace shakedown {

/// `films`: physics or none through a camera as it is (lens, shutter, depth, wander, trigger, release), in
/// a laboratory that weighs to half a per cent and says so in [known].
/// `dampers`: physics or none in another damper (masses, number and diameter of grains, frequency, release,
/// lengths), two of three with one length alone or driven all the time.
enum class BlindKind { null, parameters, single, camera, pair, unlisted, twins, films, dampers };
constexpr std::array<std::string_view, 9> blind_kind_names{
    "nulls", "parameters", "singles", "camera", "pairs", "unlisted", "twins", "films", "dampers"};

/// How many of each kind.
using BlindCounts = std::array<int, 9>;
constexpr BlindCounts full_counts{60, 60, 120, 30, 30, 24, 20, 60, 60}, small_counts{2, 1, 3, 1, 1, 1, 0, 0};
/// These take about 45 minutes: half a minute of two cores a case, and some ten minutes for the strengths.
constexpr BlindCounts lunch_counts{8, 8, 20, 6, 6, 6, 0, 12, 12};

/// Reads "nulls=10,singles=20": those kinds alone. Throws InputError.
BlindCounts parse_counts(std::string_view text, const std::string& origin = "--cases");

struct BlindCase {
  std::string name;  ///< "case_0017", in an order that tells nothing
  BlindKind kind = BlindKind::null;
  Trial trial;
  std::vector<std::string> ids;        ///< of what is hidden
  std::vector<std::string> strengths;  ///< their names in the table of signal laws
  double signal_to_noise = 0;    ///< of each hidden thing by the table of signal laws; 0: nothing hidden
  std::string twin;              ///< effect that these measurements cannot tell from the hidden one
  std::vector<PlannedRun> more;  ///< of twins: runs that decide, all lengths, other numbers of grains, none,
                                 ///< half the release
};

/// Signals to noise are drawn from what nobody can see to what nobody can miss.
constexpr double weakest_signal = 2, strongest_signal = 40;

struct BlindDesign {
  std::vector<PlannedRun> runs;   ///< the experiment of every case but the twins'
  std::vector<double> signals{};  ///< in turn; empty: log-uniform from weakest_signal to strongest_signal
  RecordingSettings recording;    ///< but for its noise, which is drawn
};
/// Returns five runs as the open cases have them, the longer boxes for as long as they swing.
BlindDesign full_design();
/// Returns two short runs and strong signals, for a first look and for tests.
BlindDesign small_design();

/// A row of twin_pairs.csv: what is hidden, and what imitates it so well in twin_runs() that with the truth
/// given the two lie less than three standard errors apart (distance_of_imitation(), at twin_signal).
struct TwinPair {
  std::string hidden, twin;
};
/// Returns the rows of the table, which the program holds, in its order.
const std::vector<TwinPair>& twin_pairs();
constexpr double twin_signal = 8;

/// Returns runs that are too little to tell twins apart: one length, one release, ten seconds.
std::vector<PlannedRun> twin_runs();

/// How a worse experiment is made of a design.
constexpr std::array<std::string_view, 7> variant_names{
    "one-repeat", "two-lengths", "half-duration", "250fps", "missing", "outliers", "no-centre"};

/// Returns the design made worse, by name in this order: one run a length; the shortest and the longest box
/// alone; half of each run; 250 frames/s; 2 % of the frames lost; 5 % of the positions jump; grains not
/// tracked. Throws InputError for another name.
BlindDesign varied(BlindDesign design, std::string_view variant, const std::string& origin = "--variant");

/// Signal against strength of everything that can be hidden, by strength_name().
using SignalLaws = std::map<std::string, SignalLaw, std::less<>>;

/// Returns the name of a strength in that table; twins have their own, as in their small experiment a
/// strength is worth less than in the full one.
std::string strength_name(std::string_view id, BlindKind kind);

/// Draws the cases. Laboratory and diagnosis differ in parameters drawn at random (of nulls and of a quarter
/// of all others but `parameters` the believed ones), in contact time, packing (three in five are as
/// believed), camera noise and seed. The same arguments give the same cases.
std::vector<BlindCase> draw_cases(const Setup& believed, const BlindCounts& counts, const BlindDesign& design,
                                  const SignalLaws& laws, std::uint64_t seed, KnownEffects known);

/// Returns the cases that this laboratory can make: an engine that does not model an effect does not hide it.
/// Their names stay.
std::vector<BlindCase> cases_within_reach(std::vector<BlindCase> cases, const Engine& laboratory);

}  // namespace shakedown
