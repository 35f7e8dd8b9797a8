// SPDX-License-Identifier: MIT
#include "feature_covariance.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>

namespace shakedown {

namespace {

/// Shrinkages that are tried: correlations are multiplied by one less these. The likelihood is flat over a
/// factor of three.
constexpr std::array shrinkages{0.003, 0.01, 0.03, 0.1, 0.3, 1.0};

/// Returns ln of the likelihood of `unseen` simulations (camera noise of the variance `white` added, averaged
/// over it) by the covariance of `seen` ones. It works in the space of simulations, which are fewer than
/// features (Woodbury): C = D + X' X with X = sqrt((1 - s) / n) seen.
double log_likelihood(const Eigen::MatrixXd& seen, const Eigen::MatrixXd& unseen,
                      const Eigen::VectorXd& white, double shrinkage) {
  const auto n = static_cast<double>(seen.rows());
  const Eigen::VectorXd variance = seen.colwise().squaredNorm().transpose() / n;
  const Eigen::VectorXd diagonal = shrinkage * variance + white;
  if (!(diagonal.minCoeff() > 0)) return -std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd x = std::sqrt((1 - shrinkage) / n) * seen;
  const Eigen::MatrixXd scaled = x * diagonal.cwiseInverse().asDiagonal();
  Eigen::MatrixXd inner = scaled * x.transpose();
  inner.diagonal().array() += 1;
  const Eigen::LLT<Eigen::MatrixXd> root(inner);
  const double log_determinant =
      diagonal.array().log().sum() + 2 * Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum();
  const Eigen::MatrixXd taken = root.matrixL().solve(scaled);  // C^-1 = D^-1 - taken' taken
  const Eigen::VectorXd inverse =
      diagonal.cwiseInverse() - taken.colwise().squaredNorm().transpose();  // its diagonal
  const double squares = ((unseen.array().square().rowwise() / diagonal.transpose().array()).sum() -
                          (taken * unseen.transpose()).squaredNorm()) /
                         static_cast<double>(unseen.rows());
  return -(log_determinant + squares + inverse.dot(white)) / 2;
}

/// Returns the shrinkage with which each half of the simulations, even and odd, tells the other best.
double best_shrinkage(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& white) {
  constexpr Eigen::Index least = 8;
  if (residuals.rows() < least) return shrinkages.back();
  const Eigen::Index half = residuals.rows() / 2;
  const Eigen::MatrixXd even = residuals(Eigen::seqN(0, half, 2), Eigen::all),
                        odd = residuals(Eigen::seqN(1, half, 2), Eigen::all);
  double best = shrinkages.back(), most = -std::numeric_limits<double>::infinity();
  for (const double shrinkage : shrinkages) {
    const double told =
        log_likelihood(even, odd, white, shrinkage) + log_likelihood(odd, even, white, shrinkage);
    if (told > most) most = told, best = shrinkage;
  }
  return best;
}

Eigen::VectorXd white_of(const FeaturePlan& plan, double model_error) {
  Eigen::VectorXd white(std::ssize(plan.features));
  for (Eigen::Index f = 0; f < white.size(); ++f)
    white[f] = std::pow(plan.features[static_cast<std::size_t>(f)].noise, 2) + model_error * model_error;
  return white;
}

Eigen::MatrixXd shrunk(const Eigen::MatrixXd& residuals, const Eigen::VectorXd& white, double shrinkage) {
  Eigen::MatrixXd covariance = residuals.transpose() * residuals / static_cast<double>(residuals.rows());
  const Eigen::VectorXd variance = covariance.diagonal();
  covariance *= 1 - shrinkage;
  covariance.diagonal() += shrinkage * variance + white;
  return covariance;
}

}  // namespace

Eigen::MatrixXd feature_covariance(const Eigen::MatrixXd& residuals, const FeaturePlan& plan,
                                   double model_error) {
  const Eigen::VectorXd white = white_of(plan, model_error);
  return shrunk(residuals, white, best_shrinkage(residuals, white));
}

Eigen::MatrixXd covariance_for_means(const Eigen::MatrixXd& residuals, const FeaturePlan& plan,
                                     double model_error) {
  constexpr double shrinkage = 0.4;
  return shrunk(residuals, white_of(plan, model_error), shrinkage);
}

}  // namespace shakedown
