// SPDX-License-Identifier: MIT
// The covariance of residuals of flights: a band of width two for each run of flights, one vector a drop.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "drop_residuals.hpp"

namespace shakedown {

/// Variances by which the parts of the covariance count.
struct RowVariances {
  double timing = 0;   ///< of an instant, s^2
  double scatter = 0;  ///< of e at each impact
  double other = 1;    ///< times what each row varies by besides (a height)
};

/// Columns divided by the root of the band part (Cholesky), run by run, and ln of its determinant.
struct BandRoot {
  double log_determinant = 0;
  Eigen::MatrixXd columns;  ///< L^-1 columns
};

class RowCovariance {
 public:
  /// Takes the weights of these rows, in their order.
  explicit RowCovariance(const std::vector<ImpactRow>& rows);
  double mean_timing() const { return mean_timing_; }    ///< mean of the diagonal for timing of 1 s
  double mean_scatter() const { return mean_scatter_; }  ///< and for scatter of 1, s^2
  /// Returns the first row of each drop, and one past the last of all.
  const std::vector<Eigen::Index>& drops() const { return drops_; }
  Eigen::VectorXd of_drop() const { return per_restitution_; }  ///< change of the rows by e of their drop
  /// Divides columns by the root L of the band part C = L L^T: returns L^-1 columns and ln det C. `columns`
  /// has a row for each row of the constructor, in the same order, and any number of columns; so has the
  /// answer.
  BandRoot divided(const RowVariances& variances, Eigen::MatrixXd columns) const;
  /// Returns L^-T columns, of the same shape: after divided() this is C^-1 columns of the band part.
  Eigen::MatrixXd divided_back(const RowVariances& variances, Eigen::MatrixXd columns) const;

 private:
  struct Factor {
    Eigen::VectorXd diagonal, next, after;  ///< L(i,i), L(i+1,i), L(i+2,i)
  };
  /// Returns the factor L of the band part, C = L L^T, lower and with two bands below the diagonal.
  Factor factor(const RowVariances& variances) const;
  Eigen::VectorXd timing_[3], per_restitution_, other_;
  std::vector<Eigen::Index> drops_;
  double mean_timing_ = 0, mean_scatter_ = 0;
};

}  // namespace shakedown
