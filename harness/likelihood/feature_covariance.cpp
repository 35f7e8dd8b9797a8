// SPDX-License-Identifier: MIT
#include "feature_covariance.hpp"

namespace shakedown {

Eigen::MatrixXd feature_covariance(const Eigen::MatrixXd& residuals, const FeaturePlan& plan,
                                   double model_error) {
  constexpr double shrinkage = 0.4;
  Eigen::MatrixXd covariance = residuals.transpose() * residuals / static_cast<double>(residuals.rows());
  const Eigen::VectorXd variance = covariance.diagonal();
  covariance *= 1 - shrinkage;
  for (Eigen::Index f = 0; f < variance.size(); ++f) {
    const double noise = plan.features[static_cast<std::size_t>(f)].noise;
    covariance(f, f) += shrinkage * variance[f] + noise * noise + model_error * model_error;
  }
  return covariance;
}

}  // namespace shakedown
