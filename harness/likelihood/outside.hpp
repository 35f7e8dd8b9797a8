// SPDX-License-Identifier: MIT
// Computes what free parameters cannot take up of a change of the features.
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace shakedown {

/// Divides columns by the square roots of the coordinates' variances and takes off what the free columns take
/// up of them (least squares). A row of the free ones below the features may say what is known of each
/// beforehand.
class Outside {
 public:
  /// `free`: coordinates x parameters; `variance`: of each coordinate, in its unit squared.
  Outside(const Eigen::MatrixXd& free, const Eigen::ArrayXd& variance);
  /// Takes every variance as one.
  explicit Outside(const Eigen::MatrixXd& free) : Outside(free, Eigen::ArrayXd::Ones(free.rows())) {}
  /// Returns what is left of these columns, in standard deviations: coordinates x columns, as they came.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const;
  /// Returns what the free parameters take of a column: one number for each, in the unit of its free column.
  Eigen::VectorXd taken_of(const Eigen::VectorXd& column) const;

 private:
  Eigen::ArrayXd scale_;
  Eigen::MatrixXd free_;
  Eigen::LLT<Eigen::MatrixXd> root_;
};

}  // namespace shakedown
