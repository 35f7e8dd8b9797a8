// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

namespace shakedown {

struct LeastSquares {
  Eigen::VectorXd coefficients;
  Eigen::VectorXd errors;  ///< standard errors from the scatter; NaN without spare points
  double rms = 0;          ///< root mean square of the residuals
};

/// Coefficients c that make |columns c - values| smallest. Needs at least as many rows as columns.
LeastSquares least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

}  // namespace shakedown
