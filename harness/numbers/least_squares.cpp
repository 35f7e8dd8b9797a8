// SPDX-License-Identifier: MIT
#include "least_squares.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "expect.hpp"

namespace shakedown {

LeastSquares least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& values) {
  EXPECT(columns.rows() == values.size() && columns.rows() >= columns.cols());
  LeastSquares fit;
  fit.coefficients = columns.colPivHouseholderQr().solve(values);
  const double sum = (columns * fit.coefficients - values).squaredNorm();
  const double rows = static_cast<double>(columns.rows());
  const double spare = rows - static_cast<double>(columns.cols());
  fit.rms = std::sqrt(sum / rows);
  const double variance = spare > 0 ? sum / spare : std::numeric_limits<double>::quiet_NaN();
  fit.errors = ((columns.transpose() * columns).inverse().diagonal() * variance).cwiseSqrt();
  return fit;
}

}  // namespace shakedown
