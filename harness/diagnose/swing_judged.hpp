// SPDX-License-Identifier: MIT
// Judges boxes without grains by their waveform, by the one rule of compare, ladder, fit and diagnose: a run
// of the equation of motion has no chaos, so there are no ensembles to ask.
#pragma once
#include <optional>

#include "known_effects.hpp"
#include "last_fit.hpp"
#include "momentum.hpp"

namespace shakedown {

/// Holds what a fit leaves of every frame, m, and what of that is noise.
struct SwingRemains {
  std::vector<WaveformRun> frames;    ///< every frame
  std::vector<Eigen::VectorXd> left;  ///< measured less modelled, of `frames`
  double wander = 0;                  ///< of the track, as far as a track may wander
  double floor = 0;                   ///< noise and wander of the noisiest run
  double error = 0;                   ///< rms of all runs
  double chi2 = 0;                    ///< by white noise
  double amplitude = 0;               ///< largest of all runs
  std::string looks_like;  ///< what the run with the largest remains leaves; empty: nothing with a name
  std::vector<Validation> validation;  ///< of each run

  /// Returns how many frames all runs have together.
  Eigen::Index frame_count() const;
  /// Returns the differences for the judgement, all runs together first. `as_given`: rms before anything was
  /// fitted, m.
  std::vector<Difference> differences(double as_given) const;
};

/// Returns what the fit leaves of every frame of the measurement. `balance` knows how the track wanders.
SwingRemains remains_of(const Measurement& measurement, const WaveformFit& fit, const MomentumAudit& balance,
                        KnownEffects known);

/// Return what stands for the p-values that an empty box has not.
ModelTest no_ensembles(), waveform_instead_of_balance();

/// Holds one setup judged beside recordings without grains.
struct JudgedSwing {
  Setup fitted;      ///< the setup with the values found
  Refit refit;       ///< values of the knobs, errors of the runs; no p-value, no cells
  double as_given;   ///< m, rms before anything but place, speed and origin of each run was fitted
  SwingFound found;  ///< every frame
  ModelJudgement judgement;
};

/// Fits the knobs (keys of the setup or of effects; what is exact arithmetic of a camera is left out) within
/// their bounds, with what is believed of the spring's frequency, and place, speed and origin of each run.
/// Returns nothing where no run swings long enough. `balance`: of this measurement; where the frequency is
/// free and nothing is believed of it, its frequency is a second start.
std::optional<JudgedSwing> judged_swing(const Setup& setup, const Measurement& measurement,
                                        const std::vector<Knob>& knobs, const MomentumAudit& balance,
                                        KnownEffects known);

/// Compares other runs with what a fit foretells of them: only place, speed and origin of each are fitted.
std::vector<RunComparison> foretold_swings(const JudgedSwing& judged, const Measurement& others,
                                           const MomentumAudit& balance, KnownEffects known);

}  // namespace shakedown
