// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

#include "features.hpp"

namespace shakedown {

/// Returns the expected covariance (m^2) of one run's features. It is the sum of chaos from run to run, as
/// the residuals (simulations x features, m) show it, of camera noise, and of `model_error` (m), by which two
/// codes of the same physics differ. Some hundred simulations tell correlations badly, so these are shrunk
/// towards none, by the share with which each half of the simulations tells the other best, as normal
/// distributions.
Eigen::MatrixXd feature_covariance(const Eigen::MatrixXd& residuals, const FeaturePlan& plan,
                                   double model_error);

/// Returns the same with correlations shrunk by 0.4, for weights that look for a change of the means: chaos
/// is no normal distribution, and such weights see a third more of a change in simulations that were not seen
/// (of the paper's damper at 104 mm with grain_grain 0.78 for 0.75, 128 simulations: signal squared 4.5 where
/// a shrinkage of 0.003 has 3.4).
Eigen::MatrixXd covariance_for_means(const Eigen::MatrixXd& residuals, const FeaturePlan& plan,
                                     double model_error);

}  // namespace shakedown
