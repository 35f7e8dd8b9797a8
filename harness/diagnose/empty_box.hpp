// SPDX-License-Identifier: MIT
// Diagnoses a box without grains. It has no chaos and no contacts, so that one run of the engine is the
// model, and the momentum balance is all there is to find.
#pragma once
#include "diagnosis.hpp"
#include "known_effects.hpp"
#include "waveform_search.hpp"

namespace shakedown {

/// Says how far the model of each run's setup lies from what was recorded.
struct SwingError {
  double error = 0;        ///< m, rms over the frames of all runs
  double chi2 = 0;         ///< by the camera's noise
  double frames = 0;       ///< compared
  double amplitude = 0;    ///< m, largest of all runs
  std::string looks_like;  ///< what the run with the largest remains leaves; empty: nothing that has a name
  std::string why_not;     ///< why the model cannot be simulated; empty: it can, else the error is infinite
};

/// Compares each run with the model of its setup. `as_stated`: released from the setup's displacement at the
/// first frame, whatever the recording says. Otherwise each run may start anywhere in the motion: from its
/// first turning point, whose time and place (and the origin, where that is unknown) are fitted, and what
/// comes before is left out.
SwingError swing_error(const Measurement& measurement, const Engine& engine, bool as_stated);

/// Fills in all of the diagnosis that follows from the waveform; `asked`: effects that may be named. Returns
/// false where no run swings long enough.
bool conclude_by_waveform(const Setup& user, const Measurement& measurement, const Engine& engine,
                          const EffectsInQuestion& asked, Diagnosis& diagnosis);

/// Fills in all of the diagnosis where no law of the list explains the waveform: with what the waveform says
/// (`by_waveform`), or with what the balance says where that knows a formula or there is no waveform.
void conclude_empty_box(const Setup& user, const Measurement& measurement, const Engine& engine,
                        KnownEffects known, const Diagnosis& by_waveform, Diagnosis& diagnosis);

}  // namespace shakedown
