// SPDX-License-Identifier: MIT
#include "least_squares.hpp"

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "expect.hpp"

namespace shakedown {

LeastSquares least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  EXPECT(columns.rows() == values.size() && columns.rows() >= columns.cols());
  LeastSquares fit;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  fit.coefficients = qr.solve(values);
  const double sum = (columns * fit.coefficients - values).squaredNorm();
  const double rows = static_cast<double>(columns.rows());
  const double spare = rows - static_cast<double>(columns.cols());
  fit.rms = std::sqrt(sum / rows);
  const double variance = spare > 0 ? sum / spare : std::numeric_limits<double>::quiet_NaN();
  // columns P = Q R, so that (columns' columns)^-1 = (P R^-1)(P R^-1)'.
  const Eigen::Index n = columns.cols();
  const Eigen::MatrixXd root =
      qr.colsPermutation() *
      qr.matrixR().topRows(n).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  fit.covariance = variance * root * root.transpose();
  fit.errors = fit.covariance.diagonal().cwiseSqrt();
  return fit;
}

Eigen::VectorXd least_squares_coefficients(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  EXPECT(columns.rows() == values.size());
  return columns.colPivHouseholderQr().solve(values);
}

Eigen::MatrixXd least_squares_weights(const Eigen::MatrixXd& columns) {
  return columns.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(columns.rows(), columns.rows()));
}

Eigen::VectorXd shortest_coefficients(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  EXPECT(columns.rows() == values.size());
  return columns.completeOrthogonalDecomposition().solve(values);
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix) {
  return matrix.completeOrthogonalDecomposition().pseudoInverse();
}

}  // namespace shakedown
