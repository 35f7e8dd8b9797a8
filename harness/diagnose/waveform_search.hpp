// SPDX-License-Identifier: MIT
// Finds which laws act on a box without grains. Sets of them are fitted to its waveform and weighed by the
// same evidence as everywhere: the fall of chi2, the share of the prior that the data leave, and the prior of
// the effects.
#pragma once
#include "evidence.hpp"
#include "known_effects.hpp"
#include "waveform.hpp"
#include "waveform_sets.hpp"

namespace shakedown {

/// Holds what the search found.
struct WaveformAnswer {
  std::vector<WaveformRun> runs;  ///< as fitted, weighed by what no law explains in the band of the swing
  std::vector<WaveformSet> sets;  ///< most probable first; empty: no run swings long enough
  std::vector<double> gain;       ///< of each law of the first set: rise of chi2 without it
  std::vector<Hypothesis> table;  ///< of the effects
  WaveformFit as_given;           ///< nothing free but place, speed and origin of each run
};

/// Returns the laws that the waveform of an empty box can tell, from the records.
std::vector<WaveformLaw> waveform_laws(const Setup& setup, KnownEffects known);

/// Holds one frequency of a periodogram.
struct PowerAt {
  double frequency = 0, power = 0;  ///< Hz; of whatever unit
};
/// Returns the frequency of a line that stands out from the noise around it, red or white; 0 where none does.
/// Frequencies ascend in steps of half the resolution.
double line_in(const std::vector<PowerAt>& spectrum);

/// Tells whether the spring's frequency is known exactly: then the setup says it, and no fit changes it.
bool knows_frequency_exactly(const Measurement& measurement);

/// Says which effects may act.
struct EffectsInQuestion {
  KnownEffects known;
  std::vector<std::string> only{};  ///< of these names; empty: all
  int threads = 1;                  ///< to ask them with; the answer does not depend on it
};

/// Searches the waveform of a measurement. `frequency`: Hz, about where the fit begins (unless it is known
/// exactly).
WaveformAnswer search_waveform(const Measurement& measurement, double frequency,
                               const EffectsInQuestion& asked);

}  // namespace shakedown
