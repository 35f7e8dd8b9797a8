// SPDX-License-Identifier: MIT
// Computes how well the data tell the free parameters, and how far they tell them apart, from the slopes of
// the features at the solution.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "refit_result.hpp"

namespace shakedown {

/// Says how well the data tell the knobs, each in its own unit.
struct ToldApart {
  Eigen::MatrixXd covariance;   ///< of the estimates, each knob in its own unit
  Eigen::VectorXd error;        ///< their standard errors
  Eigen::MatrixXd correlation;  ///< of the estimates
  Eigen::VectorXd alone;        ///< standard error if all other knobs were known
};

/// Estimates by weighted least squares with the covariance of one half of the simulations. The spread of the
/// estimates is taken from the residuals of the other half (and camera noise), which the weights have not
/// seen; what a run has of its own counts in both. `emulators` are of the measured runs with the knobs at the
/// solution; `model_error` (m) is added to each feature as in a refit. What is believed of a knob, and its
/// bounds, count as if they were measured.
ToldApart told_apart(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                     const std::vector<Emulator>& emulators, double model_error);

/// Compares a measured run with what the model foretells of it: the error, and the spread that chaos from run
/// to run, camera noise and the parameters' own uncertainty make. `emulator`: as above, of this run;
/// `parameters`: covariance of the knobs, in their units.
RunComparison foretold(const MeasuredFeatures& measured, const std::vector<Knob>& knobs,
                       const Emulator& emulator, const Eigen::MatrixXd& parameters, double model_error);

}  // namespace shakedown
