// SPDX-License-Identifier: MIT
#include "signature.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "expect.hpp"

namespace shakedown {

namespace {

/// Returns the order of the polynomial for this many levels.
Eigen::Index order_of(std::size_t levels) {
  constexpr std::size_t for_a_cubic = 4;
  return levels >= for_a_cubic ? 3 : levels > 1 ? 2 : 1;
}

/// Returns the strengths, ascending, between which the change is straight; empty where a polynomial will do.
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
  shared_ = of_levels.rowwise().sum();
  of_nothing_ = exact ? 0 : without.noise;
  square_ = shapes_.transpose() * shapes_;
  noise_ =
      of_levels * noise.asDiagonal() * of_levels.transpose() + of_nothing_ * shared_ * shared_.transpose();
  overlap_ = shapes_.transpose() * without.residual - of_nothing_ * shared_;
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

PairSignature::PairSignature(const Signature& first, const Signature& second)
    : first_(&first), second_(&second), cross_(first.shapes_.transpose() * second.shapes_) {
  const double both = std::min(first.of_nothing_, second.of_nothing_);  // what is exact shares none
  shared_ = both * first.shared_ * second.shared_.transpose();
}

double PairSignature::log_likelihood(double first, double second) const {
  const Eigen::VectorXd v = first_->weights(first), w = second_->weights(second);
  const double noise = v.dot(first_->noise_ * v) + w.dot(second_->noise_ * w) + 2 * v.dot(shared_ * w);
  const double square =
      v.dot(first_->square_ * v) + w.dot(second_->square_ * w) + 2 * v.dot(cross_ * w) - noise;
  if (!(square > 0)) return 0;
  const double overlap = first_->overlap_.dot(v) + second_->overlap_.dot(w);
  return square * (overlap - square / 2) / (square + noise * std::max(1.0, first_->chi2_per_feature_));
}

namespace {

/// Returns strengths that are equally likely beforehand: a Cauchy distribution is uniform in the angle whose
/// tangent is the strength over the prior's scale.
Eigen::ArrayXd likely_strengths(const StrengthPrior& prior, int steps) {
  EXPECT(prior.typical > 0 && prior.low < prior.high);
  const double first = std::atan(prior.low / prior.typical), last = std::atan(prior.high / prior.typical);
  Eigen::ArrayXd strength(steps);
  for (int i = 0; i < steps; ++i)
    strength[i] = prior.typical * std::tan(first + (i + 0.5) / steps * (last - first));
  return strength;
}

}  // namespace

PairPosterior posterior_of(const Signature& first, const StrengthPrior& of_first, const Signature& second,
                           const StrengthPrior& of_second) {
  constexpr int steps = 100;
  const Eigen::ArrayXd x = likely_strengths(of_first, steps), y = likely_strengths(of_second, steps);
  const PairSignature both(first, second);
  Eigen::ArrayXXd likelihood(steps, steps);
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) likelihood(i, j) = both.log_likelihood(x[i], y[j]);
  PairPosterior found;
  if (!likelihood.isFinite().all()) {
    found.log_evidence = std::numeric_limits<double>::quiet_NaN();
    return found;
  }
  Eigen::Index row = 0, column = 0;
  const double most = likelihood.maxCoeff(&row, &column);
  found.log_evidence = most + std::log((likelihood - most).exp().mean());
  found.first = x[row], found.second = y[column];
  return found;
}

StrengthPosterior posterior_of(const Signature& signature, const StrengthPrior& prior) {
  constexpr int steps = 2000;
  const Eigen::ArrayXd strength = likely_strengths(prior, steps);
  Eigen::ArrayXd likelihood(steps);
  for (int i = 0; i < steps; ++i) likelihood[i] = signature.log_likelihood(strength[i]);
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
  // Flat in the strength: each of the steps counts by its width.
  const Eigen::ArrayXd weight = relative * (1 + (strength / prior.typical).square());
  const double mean = (weight * strength).sum() / weight.sum();
  found.error = std::sqrt((weight * (strength - mean).square()).sum() / weight.sum());
  return found;
}

}  // namespace shakedown
