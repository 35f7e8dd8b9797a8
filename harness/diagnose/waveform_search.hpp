// SPDX-License-Identifier: MIT
// Which laws act on a box without grains? Sets of them are fitted to its waveform and weighed by the same
// evidence as everywhere: the fall of chi2, the share of the prior that the data leave, and the prior of the
// effects.
#pragma once
#include "evidence.hpp"
#include "known_effects.hpp"
#include "waveform.hpp"

namespace shakedown {

/// A set of laws, fitted.
struct WaveformSet {
  WaveformFit fit;
  double log_odds = 0;  ///< ln of its probability over that of no law at all
};

struct WaveformAnswer {
  std::vector<WaveformRun> runs;  ///< as fitted, weighed by what no law explains in the band of the swing
  std::vector<WaveformSet> sets;  ///< most probable first; empty: no run swings long enough
  std::vector<double> gain;       ///< of each law of the first set: what chi2 loses without it
  std::vector<Hypothesis> table;  ///< of the effects
  WaveformFit as_given;           ///< nothing free but place, speed and origin of each run
};

/// The laws that the waveform of an empty box can tell, from the records.
std::vector<WaveformLaw> waveform_laws(const Setup& setup, KnownEffects known);

/// Of one family and told by a waveform alone: a sine beside a cubic, a tilt beside a spring stiffer to one
/// side say the same twice.
bool say_the_same(const WaveformLaw& one, const WaveformLaw& other);

/// Whether a law of a fit says what one before it says.
bool says_it_twice(const WaveformFit& fit, std::size_t which);

/// ln of prior and of the share that the data leave of it, of the laws of a fit; -infinity where one of them
/// cannot be what it is fitted to be. `candidates`: how many laws were in question.
double log_prior_odds(const WaveformFit& fit, double candidates, double swing_frequency);

/// One frequency of a periodogram.
struct PowerAt {
  double frequency = 0, power = 0;  ///< Hz; of whatever unit
};
/// The frequency of a line that stands out from the noise around it, red or white; 0: none does. Frequencies
/// ascend in steps of half the resolution.
double line_in(const std::vector<PowerAt>& spectrum);

/// Whether the spring's frequency is no matter of a fit: the setup says it.
bool knows_frequency_exactly(const Measurement& measurement);

/// Which effects may act.
struct EffectsInQuestion {
  KnownEffects known;
  std::vector<std::string> only{};  ///< of these names; empty: all
  int threads = 1;                  ///< to ask them with; the answer does not depend on it
};

/// `frequency`: Hz, about where the fit begins (unless it is known exactly).
WaveformAnswer search_waveform(const Measurement& measurement, double frequency,
                               const EffectsInQuestion& asked);

}  // namespace shakedown
