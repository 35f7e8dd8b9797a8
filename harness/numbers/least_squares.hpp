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

/// Finds the coefficients c that make |columns c - values| smallest (QR with pivoting). Needs at least as
/// many rows as columns. For values of different errors divide each row and value by its error first.
LeastSquares least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// Returns the coefficients alone.
Eigen::VectorXd least_squares_coefficients(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// Returns the matrix W with coefficients = W values for any values; its shape is (columns, rows).
Eigen::MatrixXd least_squares_weights(const Eigen::MatrixXd& columns);

/// Returns the shortest of all best-fitting coefficients, where columns depend on each other (complete
/// orthogonal decomposition).
Eigen::VectorXd shortest_coefficients(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values);

/// Returns the inverse of Moore and Penrose, which singular matrices have too.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix);

}  // namespace shakedown
