// SPDX-License-Identifier: MIT
#include "row_covariance.hpp"

#include <cmath>

namespace shakedown {

RowCovariance::RowCovariance(const std::vector<ImpactRow>& rows) {
  const Eigen::Index count = std::ssize(rows);
  for (Eigen::VectorXd& band : timing_) band = Eigen::VectorXd::Zero(count);
  per_restitution_.resize(count);
  other_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ImpactRow& row = rows[static_cast<std::size_t>(i)];
    const auto& a = row.instants;
    timing_[0][i] = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
    per_restitution_[i] = row.per_restitution;
    other_[i] = row.other_variance;
    if (drops_.empty() || rows[static_cast<std::size_t>(drops_.back())].drop != row.drop) drops_.push_back(i);
    const auto with = [&](Eigen::Index j) -> const ImpactRow* {
      if (j >= count || rows[static_cast<std::size_t>(j)].flights != row.flights) return nullptr;
      return &rows[static_cast<std::size_t>(j)];
    };
    if (const ImpactRow* next = with(i + 1))
      timing_[1][i] = a[1] * next->instants[0] + a[2] * next->instants[1];
    if (const ImpactRow* after = with(i + 2)) timing_[2][i] = a[2] * after->instants[0];
  }
  drops_.push_back(count);
  mean_timing_ = timing_[0].mean();
  mean_scatter_ = per_restitution_.squaredNorm() / static_cast<double>(count);
}

RowCovariance::Factor RowCovariance::factor(const RowVariances& variances) const {
  const Eigen::Index count = per_restitution_.size();
  Factor f{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    double diagonal = variances.timing * timing_[0][i] +
                      variances.scatter * per_restitution_[i] * per_restitution_[i] +
                      variances.other * other_[i];
    double next = variances.timing * timing_[1][i];
    if (i > 0) diagonal -= f.next[i - 1] * f.next[i - 1], next -= f.next[i - 1] * f.after[i - 1];
    if (i > 1) diagonal -= f.after[i - 2] * f.after[i - 2];
    f.diagonal[i] = std::sqrt(std::max(diagonal, 1e-300));
    f.next[i] = next / f.diagonal[i];
    f.after[i] = variances.timing * timing_[2][i] / f.diagonal[i];
  }
  return f;
}

BandRoot RowCovariance::divided(const RowVariances& variances, Eigen::MatrixXd columns) const {
  const Factor f = factor(variances);
  BandRoot root;
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    if (i > 0) columns.row(i) -= f.next[i - 1] * columns.row(i - 1);
    if (i > 1) columns.row(i) -= f.after[i - 2] * columns.row(i - 2);
    columns.row(i) /= f.diagonal[i];
    root.log_determinant += 2 * std::log(f.diagonal[i]);
  }
  root.columns = std::move(columns);
  return root;
}

Eigen::MatrixXd RowCovariance::divided_back(const RowVariances& variances, Eigen::MatrixXd columns) const {
  const Factor f = factor(variances);
  for (Eigen::Index i = columns.rows(); i-- > 0;) {
    if (i + 1 < columns.rows()) columns.row(i) -= f.next[i] * columns.row(i + 1);
    if (i + 2 < columns.rows()) columns.row(i) -= f.after[i] * columns.row(i + 2);
    columns.row(i) /= f.diagonal[i];
  }
  return columns;
}

}  // namespace shakedown
