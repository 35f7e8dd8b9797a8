// SPDX-License-Identifier: MIT
#include "feature_coordinates.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace shakedown {

Coordinates::Coordinates(const MeasuredFeatures& measured, const Eigen::MatrixXd& covariance,
                         double model_error) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  Eigen::MatrixXd known =
      with_own(Eigen::MatrixXd::Zero(measured.values.size(), measured.values.size()), measured);
  for (Eigen::Index f = 0; f < known.rows(); ++f)
    known(f, f) +=
        std::pow(measured.plan.features[static_cast<std::size_t>(f)].noise, 2) + model_error * model_error;
  const Eigen::MatrixXd half = root.matrixL().solve(known);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(
      root.matrixL().solve(half.transpose()).transpose());
  to_ = axes.eigenvectors().transpose() *
        root.matrixL().solve(Eigen::MatrixXd::Identity(known.rows(), known.rows()));
  chaos_ = (1 - axes.eigenvalues().array()).max(0.0).min(1.0);
}

Eigen::ArrayXd Coordinates::variance(const Eigen::MatrixXd& residuals) const {
  constexpr Eigen::Index parts = 4;
  const Eigen::ArrayXd seen = (residuals * to_.transpose()).colwise().squaredNorm().transpose().array() /
                              static_cast<double>(residuals.rows());
  Eigen::ArrayXd variance = 1 - chaos_;
  for (Eigen::Index part = 0; part < parts; ++part) {
    const Eigen::Index from = part * chaos_.size() / parts, count = (part + 1) * chaos_.size() / parts - from;
    const double expected = chaos_.segment(from, count).sum();
    if (expected > 0)
      variance.segment(from, count) +=
          chaos_.segment(from, count) * (seen.segment(from, count).sum() / expected);
  }
  return variance;
}

Eigen::MatrixXd Coordinates::filmed(const Eigen::MatrixXd& residuals, Random& random) const {
  Eigen::MatrixXd rows = residuals * to_.transpose();
  for (Eigen::Index f = 0; f < rows.cols(); ++f) {
    const double noise = std::sqrt(1 - chaos_[f]);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) rows(i, f) += noise * random.normal();
  }
  return rows;
}

double Coordinates::chaos(const Eigen::MatrixXd& residuals) const {
  return (residuals * to_.transpose()).squaredNorm() / static_cast<double>(residuals.rows());
}

}  // namespace shakedown
