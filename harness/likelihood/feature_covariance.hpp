// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

#include "features.hpp"

namespace shakedown {

/// Expected covariance (m^2) of one run's features: chaos from run to run as the residuals (simulations x
/// features, m) show it, with correlations shrunk towards none by the share with which each half of the
/// simulations tells the other best (as normal distributions); camera noise; and `model_error` (m), by which
/// two codes of the same physics differ.
Eigen::MatrixXd feature_covariance(const Eigen::MatrixXd& residuals, const FeaturePlan& plan,
                                   double model_error);

}  // namespace shakedown
