// SPDX-License-Identifier: MIT
// Computes what the errors of weighed or measured numbers of the damper do to the features, so that a model
// is not rejected for a box that was let go half a millimetre farther out.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "emulator.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Names the stage in which the columns below are simulated, as a user is told it.
constexpr const char* damper_weighed = "what release and masses are uncertain by";

/// Describes one number of the damper that is known to an error.
struct DamperError {
  std::string key;                  ///< of the setup, "box.mass"
  std::vector<double> deviation{};  ///< of each run, SI; 0: known exactly there
  bool each_run = false;            ///< every run has its own (where it was let go); else all share one
  /// For each run its value less the one that it is simulated with, SI; empty: no run differs. Repeats, alike
  /// but for where they were let go, are simulated from the mean of their releases and so share simulations.
  std::vector<double> shift{};
};

/// Returns the errors of the masses, as `[known]` has them or as such things are usually weighed, and of the
/// release of each run that was measured. Runs without grains, those that do not begin with a release, and
/// those whose grains were measured in the same frame as the box (it would be moved through them) have none.
std::vector<DamperError> damper_errors(const Measurement& measurement);

/// Simulations of each setup from which a column is made: an eleventh of the chaos is left in one of four
/// standard deviations.
constexpr int simulations_of_a_column = 16;

/// Change of the features of each run by one number of the damper, m per unit.
using FeatureColumns = std::vector<Eigen::VectorXd>;
/// Returns the columns of each error. The number is moved by a fiftieth of its value, but by no less than two
/// and no more than four standard deviations, or by three times the greatest shift where that is more. A
/// column is the mean of `count` simulations less that of as many without the move, from the same
/// microstates, so that the first strokes have no noise, divided by the move.
std::vector<FeatureColumns> columns_of(const std::vector<DamperError>& errors,
                                       const std::vector<MeasuredFeatures>& measured, int count,
                                       int first_run, const Workshop& workshop);

/// Puts the columns into the features: into MeasuredFeatures::own where each run has an error of its own,
/// else into by_camera, as columns of knobs. A run with a shift is from now on one with the value that its
/// repeats share.
void add_columns(const std::vector<DamperError>& errors, const std::vector<FeatureColumns>& columns,
                 KnownEffects known, std::vector<MeasuredFeatures>& measured);

/// Returns knobs for the errors that all runs share; they are exact, because their columns are known.
std::vector<Knob> knobs_of(const std::vector<DamperError>& errors, const Setup& setup);

}  // namespace shakedown
