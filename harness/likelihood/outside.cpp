// SPDX-License-Identifier: MIT
#include "outside.hpp"

namespace shakedown {

Outside::Outside(const Eigen::MatrixXd& free, const Eigen::ArrayXd& variance)
    : scale_(variance.rsqrt()), free_(scale_.matrix().asDiagonal() * free) {
  constexpr double open = 1e-9;  // a parameter that nothing tells of stays where it is
  Eigen::MatrixXd normal = free_.transpose() * free_;
  normal.diagonal().array() += open;
  root_.compute(normal);
}

Eigen::MatrixXd Outside::operator()(const Eigen::MatrixXd& columns) const {
  const Eigen::MatrixXd scaled = scale_.matrix().asDiagonal() * columns;
  if (free_.cols() == 0) return scaled;
  return scaled - free_ * root_.solve(free_.transpose() * scaled);
}

Eigen::VectorXd Outside::taken_of(const Eigen::VectorXd& column) const {
  if (free_.cols() == 0) return Eigen::VectorXd(0);
  return root_.solve(free_.transpose() * (scale_.matrix().asDiagonal() * column));
}

}  // namespace shakedown
