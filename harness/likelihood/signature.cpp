// SPDX-License-Identifier: MIT
#include "signature.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "expect.hpp"

namespace shakedown {

namespace {

/// Of a polynomial through so many levels.
Eigen::Index order_of(std::size_t levels) { return levels > 3 ? 3 : levels > 1 ? 2 : 1; }

/// Ascending; empty where a polynomial will do.
std::vector<double> corners_of(const std::vector<SignatureLevel>& levels) {
  constexpr double most_of_a_polynomial = 16;  // strongest over weakest
  std::vector<double> corners;
  for (const SignatureLevel& level : levels) corners.push_back(level.strength);
  std::sort(corners.begin(), corners.end());
  if (corners.front() <= 0 || corners.back() < most_of_a_polynomial * corners.front()) return {};
  return corners;
}

}  // namespace

Signature::Signature(const std::vector<SignatureLevel>& levels, const SignatureResidual& without,
                     bool exact) {
  EXPECT(!levels.empty());
  const auto count = std::ssize(levels);
  corners_ = corners_of(levels);
  order_ = corners_.empty() ? order_of(levels.size()) : count;
  const Eigen::Index order = order_, features = without.residual.size();
  unit_ = 0;
  for (const SignatureLevel& level : levels) unit_ = std::max(unit_, std::abs(level.strength));
  EXPECT(unit_ > 0);
  Eigen::MatrixXd design(count, order), changes(features, count);
  Eigen::VectorXd noise(count), weight(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SignatureLevel& level = levels[static_cast<std::size_t>(k)];
    design.row(k) = weights(level.strength).transpose();
    changes.col(k) = level.change;
    noise[k] = level.noise;
    weight[k] = level.noise > 0 ? 1 / level.noise : 1;
  }
  const Eigen::MatrixXd weighted = design.transpose() * weight.asDiagonal();
  const Eigen::MatrixXd of_levels = (weighted * design).ldlt().solve(weighted);  // order x levels
  shapes_ = changes * of_levels.transpose();
  const Eigen::VectorXd shared = of_levels.rowwise().sum();
  const double of_nothing = exact ? 0 : without.noise;
  square_ = shapes_.transpose() * shapes_;
  noise_ = of_levels * noise.asDiagonal() * of_levels.transpose() + of_nothing * shared * shared.transpose();
  overlap_ = shapes_.transpose() * without.residual - of_nothing * shared;
  chi2_per_feature_ =
      without.residual.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, features));
}

Eigen::VectorXd Signature::weights(double strength) const {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(order_);
  if (corners_.empty()) {
    double power = 1;
    for (double& one : weights) one = power *= strength / unit_;
    return weights;
  }
  const auto above = std::min<Eigen::Index>(
      std::lower_bound(corners_.begin(), corners_.end(), strength) - corners_.begin(), order_ - 1);
  const double low = above > 0 ? corners_[static_cast<std::size_t>(above - 1)] : 0,
               high = corners_[static_cast<std::size_t>(above)], along = (strength - low) / (high - low);
  weights[above] = along;
  if (above > 0) weights[above - 1] = 1 - along;
  return weights;
}

Eigen::VectorXd Signature::change(double strength) const { return shapes_ * weights(strength); }

Signature::Squares Signature::squares(const Eigen::VectorXd& weights) const {
  const double noise = weights.dot(noise_ * weights);
  return {std::max(0.0, weights.dot(square_ * weights) - noise), noise * std::max(1.0, chi2_per_feature_)};
}

double Signature::log_likelihood(double strength) const {
  const Eigen::VectorXd v = weights(strength);
  const auto [square, noise] = squares(v);
  if (!(square > 0)) return 0;
  return square * (overlap_.dot(v) - square / 2) / (square + noise);
}

double Signature::share_seen(double strength) const {
  const auto [square, noise] = squares(weights(strength));
  return square > 0 ? square / (square + noise) : 0;
}

StrengthPosterior posterior_of(const Signature& signature, const StrengthPrior& prior) {
  EXPECT(prior.typical > 0 && prior.low < prior.high);
  constexpr int steps = 2000;
  // A Cauchy distribution is uniform in the angle whose tangent the strength is.
  const double first = std::atan(prior.low / prior.typical), last = std::atan(prior.high / prior.typical);
  Eigen::ArrayXd strength(steps), likelihood(steps);
  for (int i = 0; i < steps; ++i) {
    strength[i] = prior.typical * std::tan(first + (i + 0.5) / steps * (last - first));
    likelihood[i] = signature.log_likelihood(strength[i]);
  }
  StrengthPosterior found;
  if (!likelihood.isFinite().all()) {
    found.log_evidence = std::numeric_limits<double>::quiet_NaN();
    return found;
  }
  Eigen::Index at = 0;
  const double most = likelihood.maxCoeff(&at);
  const Eigen::ArrayXd relative = (likelihood - most).exp();
  found.log_evidence = most + std::log(relative.mean());
  found.gain = 2 * std::max(0.0, most);
  found.strength = strength[at];
  found.share_seen = signature.share_seen(strength[at]);
  // Flat in the strength: each of the steps by its width.
  const Eigen::ArrayXd weight = relative * (1 + (strength / prior.typical).square());
  const double mean = (weight * strength).sum() / weight.sum();
  found.error = std::sqrt((weight * (strength - mean).square()).sum() / weight.sum());
  return found;
}

}  // namespace shakedown
