// SPDX-License-Identifier: MIT
// Coordinates of a run's features in which chaos from run to run has no correlations.
#pragma once
#include <Eigen/Core>

#include "emulator.hpp"
#include "random.hpp"

namespace shakedown {

/// Coordinates of one run's features in which its metric is one and chaos from run to run has no
/// correlations: a share of each coordinate's variance is chaos, the rest the camera's and the run's own.
class Coordinates {
 public:
  /// `covariance`: of the features, m^2; `model_error`: what two codes differ by in a feature, m.
  Coordinates(const MeasuredFeatures& measured, const Eigen::MatrixXd& covariance, double model_error);
  /// Of a change of the features, m.
  Eigen::VectorXd operator()(const Eigen::VectorXd& features) const { return to_ * features; }
  /// Of each coordinate where simulations have these residuals (simulations x features, m). Between them
  /// chaos is as in the metric but for a factor in each quarter of the coordinates, by their share of chaos:
  /// some simulations tell that well.
  Eigen::ArrayXd variance(const Eigen::MatrixXd& residuals) const;
  /// Single simulations as a camera would have filmed them: simulations x coordinates.
  Eigen::MatrixXd filmed(const Eigen::MatrixXd& residuals, Random& random) const;
  /// Expected square of one simulation's chaos, all coordinates.
  double chaos(const Eigen::MatrixXd& residuals) const;

 private:
  Eigen::MatrixXd to_;
  Eigen::ArrayXd chaos_;  ///< share of each coordinate, descending
};

}  // namespace shakedown
