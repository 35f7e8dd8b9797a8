// SPDX-License-Identifier: MIT
// Finds coordinates of a run's features in which chaos from run to run has no correlations.
#pragma once
#include <Eigen/Core>

#include "emulator.hpp"
#include "random.hpp"

namespace shakedown {

/// Turns one run's features into coordinates in which their covariance is the identity and chaos from run to
/// run has no correlations. A share of each coordinate's variance is chaos; the rest is the camera's, the
/// run's own and the difference of two codes.
class Coordinates {
 public:
  /// `covariance`: of the features, m^2; `model_error`: what two codes differ by in a feature, m.
  Coordinates(const MeasuredFeatures& measured, const Eigen::MatrixXd& covariance, double model_error);
  /// Turns a change of the features (m) into these coordinates.
  Eigen::VectorXd operator()(const Eigen::VectorXd& features) const { return to_ * features; }
  /// Returns the variance of each coordinate, given simulations with these residuals (simulations x features,
  /// m). Between the coordinates chaos is as in the covariance but for one factor in each quarter of them,
  /// ordered by their share of chaos: a few simulations tell that well.
  Eigen::ArrayXd variance(const Eigen::MatrixXd& residuals) const;
  /// Returns single simulations as a camera would have filmed them: simulations x coordinates.
  Eigen::MatrixXd filmed(const Eigen::MatrixXd& residuals, Random& random) const;
  /// Returns the expected square of one simulation's chaos, summed over all coordinates.
  double chaos(const Eigen::MatrixXd& residuals) const;

 private:
  Eigen::MatrixXd to_;
  Eigen::ArrayXd chaos_;  ///< share of each coordinate, descending
};

}  // namespace shakedown
