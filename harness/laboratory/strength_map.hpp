// SPDX-License-Identifier: MIT
// Tells how good a camera must be: for a design of an experiment, the smallest strength of each effect that a
// diagnosis would see, against noise, wander, shutter, number of runs and what is known of the restitutions.
// One set of simulations serves all cameras: what changes from one to another is arithmetic.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "candidates.hpp"
#include "emulator.hpp"
#include "execution.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Describes the experiment as planned but for one thing.
struct MapLine {
  std::string varied;            ///< "noise of a frame"; empty: as planned
  std::string value;             ///< "0.1 mm", for people
  double number = 0;             ///< the same: mm, ms, runs; of restitutions the standard error
  double noise = 1;              ///< of a frame, times that planned
  double wander = 0;             ///< m, on top of what is planned, over wander_time
  double wander_time = 0.3;      ///< s
  double shutter = -1;           ///< s, to which the time to read the rows is known; negative: as planned
  double runs = 1;               ///< each planned run so many times
  double restitution_error = 0;  ///< to which both restitutions are known; 0: as planned
};

/// Returns the experiment as planned, then each thing varied by itself. `noise`: of a frame as planned, m.
std::vector<MapLine> usual_lines(double noise);

/// Holds the smallest strengths of one effect.
struct MappedEffect {
  std::string effect, key, unit;
  double typical = 0;            ///< SI; of a length (a pendulum) the length
  std::vector<double> smallest;  ///< of each line, SI; infinite: not at the strongest that is looked for (of
                                 ///< a length 0)
};

/// Holds the smallest strengths of all effects, and what was left out.
struct StrengthMap {
  std::vector<MapLine> lines;
  std::vector<MappedEffect> effects;
  struct LeftOut {
    std::string key, reason;
  };
  std::vector<LeftOut> left_out;
  std::int64_t simulations = 0;
  double seconds = 0;
};

/// Says what is mapped and how much is simulated.
struct MapOptions {
  KnownEffects known;
  std::vector<std::string> effects;  ///< these only; empty: all that a diagnosis may add
  int count = 48;                    ///< simulations of each different setup at each strength
  Execution execution{};
  double seconds = 600;                  ///< effects not begun by then are left out and named
  SimulationJournal* journal = nullptr;  ///< may be null
  std::function<void(const std::string& stage, double fraction)> progress{};  ///< may be empty
};

/// Maps the smallest strengths that are seen. Seen means: the evidence that a diagnosis would find in the
/// mean of such experiments, with restitutions, frequency and camera free within what is known of them, makes
/// the effect more probable than 95 % beside nothing; so in half of the experiments it would be seen.
/// `planned`: measurements as the experiment would make them, nothing hidden in them, of the setup as
/// believed. Throws InputError where no run has grains, Interrupted.
StrengthMap strength_map(const Setup& setup, const Measurement& planned, const Engine& engine,
                         const std::vector<MapLine>& lines, const MapOptions& options);

}  // namespace shakedown
