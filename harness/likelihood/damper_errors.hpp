// SPDX-License-Identifier: MIT
// Numbers of the damper that were weighed or measured to an error: what each does to the features, so that a
// model is not rejected for a box that was let go half a millimetre farther out.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "emulator.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"

namespace shakedown {

struct DamperError {
  std::string key;                  ///< of the setup, "box.mass"
  std::vector<double> deviation{};  ///< of each run, SI; 0: known exactly there
  bool each_run = false;            ///< every run has its own (where it was let go); else all share one
  /// Of each run, SI: its value less the one that it is simulated with. Repeats, alike but for where they
  /// were let go, are simulated from the mean of their releases and so share simulations; empty: none are.
  std::vector<double> shift{};
};

/// Masses as `[known]` has them or as such things are weighed, and the release of each run that was measured.
/// Runs without grains, those that do not begin with a release, and those whose grains were measured in the
/// same frame as the box (it would be moved through them) have none.
std::vector<DamperError> damper_errors(const Measurement& measurement);

/// Of each run the change of the features by two to four standard deviations, a fiftieth of the value where
/// that lies between, or by three times the greatest shift where that is more, divided by the value's change,
/// m per unit: the means of `count` simulations less those of as many without the change, from the same
/// microstates, so that the first strokes have no noise.
using FeatureColumns = std::vector<Eigen::VectorXd>;
std::vector<FeatureColumns> columns_of(const std::vector<DamperError>& errors,
                                       const std::vector<MeasuredFeatures>& measured, int count,
                                       int first_run, const Workshop& workshop);

/// Puts them into the features: among what each run has of its own, or as columns of knobs. A run with a
/// shift is from now on one of the value that its repeats share.
void add_columns(const std::vector<DamperError>& errors, const std::vector<FeatureColumns>& columns,
                 KnownEffects known, std::vector<MeasuredFeatures>& measured);

/// Knobs of what all runs share; exact, for the columns are known.
std::vector<Knob> knobs_of(const std::vector<DamperError>& errors, const Setup& setup);

}  // namespace shakedown
