// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>

namespace shakedown {

struct LeastSquares {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;  ///< of the coefficients, from the scatter; NaN without spare points
  Eigen::VectorXd errors;      ///< standard errors: roots of its diagonal
  double rms = 0;              ///< root mean square of the residuals
};

/// Coefficients c that make |columns c - values| smallest (QR with pivoting). Needs at least as many rows as
/// columns. For values of different errors divide each row and value by its error first.
LeastSquares least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

}  // namespace shakedown
