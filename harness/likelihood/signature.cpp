// SPDX-License-Identifier: MIT
#include "signature.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "expect.hpp"

namespace shakedown {

namespace {

/// Expected product of the deviations from a straight line at two strengths, in units of the strongest: by a
/// random walk, straight from level to level; by its integral, along a cubic spline; or by a parabola and the
/// integral's integral. What is no parabola deviates on both sides of nothing on its own.
double bent_by(double a, double b, int integrals) {
  const double less = std::min(std::abs(a), std::abs(b)), more = std::max(std::abs(a), std::abs(b)),
               parabola = integrals == 2 ? std::pow(a * b, 2) / 4 : 0;
  if (!(a * b > 0)) return parabola;
  switch (integrals) {
    case 0: return less;
    case 1: return less * less * (3 * more - less) / 6;
    default: return parabola + std::pow(less, 3) * (10 * more * more - 5 * more * less + less * less) / 120;
  }
}

/// The changes at two levels, by a line of any slope and what bends it.
Eigen::MatrixXd expected(const std::vector<double>& at, double line, double bend, int integrals) {
  const auto count = std::ssize(at);
  Eigen::MatrixXd products(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j) {
      const double a = at[static_cast<std::size_t>(i)], b = at[static_cast<std::size_t>(j)];
      products(i, j) = line * a * b + bend * bent_by(a, b, integrals);
    }
  return products;
}

/// ln of the likelihood of levels with these products of changes, per feature.
double log_likelihood_of(const Eigen::MatrixXd& products, const Eigen::MatrixXd& covariance) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  if (root.info() != Eigen::Success) return -std::numeric_limits<double>::infinity();
  return -root.solve(products).trace() / 2 - root.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

Signature::Signature(const std::vector<SignatureLevel>& levels, const SignatureResidual& without,
                     bool exact) {
  EXPECT(!levels.empty());
  const auto count = std::ssize(levels);
  const Eigen::Index features = without.residual.size();
  unit_ = 0;
  for (const SignatureLevel& level : levels) unit_ = std::max(unit_, std::abs(level.strength));
  EXPECT(unit_ > 0);
  changes_.resize(features, count);
  Eigen::VectorXd noise(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const SignatureLevel& level = levels[static_cast<std::size_t>(k)];
    at_.push_back(level.strength / unit_);
    changes_.col(k) = level.change;
    noise[k] = level.noise;
  }
  of_nothing_ = exact ? 0 : without.noise;
  square_ = changes_.transpose() * changes_;
  noise_ = noise.asDiagonal();
  noise_.array() += of_nothing_;
  overlap_ = (changes_.transpose() * without.residual).array() - of_nothing_;
  chi2_per_feature_ =
      without.residual.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, features));
  choose_curve();
}

void Signature::choose_curve() {
  if (at_.size() == 1) return;  // a line
  // Of the slope nothing is known beforehand: ten times what any level shows.
  constexpr double any_slope = 100;
  double steepest = 0;
  for (Eigen::Index k = 0; k < square_.rows(); ++k)
    steepest = std::max(steepest, square_(k, k) / std::pow(at_[static_cast<std::size_t>(k)], 2));
  if (!(steepest > 0)) steepest = 1;
  line_ = any_slope * steepest;
  const auto features = static_cast<double>(changes_.rows());
  double most = -std::numeric_limits<double>::infinity();
  // From a line, for all purposes, to levels that have nothing to do with each other: half decades.
  constexpr int weakest = -12, strongest = 2;
  for (const int integrals : {2, 1, 0})
    for (int half_decade = weakest; half_decade <= strongest; ++half_decade) {
      const double bend = steepest * std::pow(10.0, half_decade / 2.0);
      Eigen::MatrixXd covariance = expected(at_, line_, bend, integrals) + noise_;
      covariance.diagonal() *= 1 + 1e-12;  // of exact levels that are close to each other
      const double likelihood = log_likelihood_of(square_ / features, covariance / features);
      if (inverse_.size() > 0 && !(likelihood > most)) continue;
      most = likelihood, bend_ = bend, integrals_ = integrals;
      inverse_ = covariance.llt().solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
    }
}

Eigen::VectorXd Signature::weights(double strength) const {
  const double u = strength / unit_;
  if (at_.size() == 1) return Eigen::VectorXd::Constant(1, u / at_.front());
  Eigen::VectorXd along(std::ssize(at_));
  for (std::size_t k = 0; k < at_.size(); ++k)
    along[static_cast<Eigen::Index>(k)] = line_ * u * at_[k] + bend_ * bent_by(u, at_[k], integrals_);
  return inverse_ * along;
}

Eigen::VectorXd Signature::change(double strength) const { return changes_ * weights(strength); }

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

double Signature::most_likely_at_best(const Eigen::ArrayXd& strengths) const {
  constexpr double one_in_twenty = 1.645;  // standard deviations
  const auto at_best = [&](const Eigen::VectorXd& v) {
    const auto [square, noise] = squares(v);
    return overlap_.dot(v) + one_in_twenty * std::sqrt(noise) - square / 2;
  };
  double most = 0;
  for (const double strength : strengths) most = std::max(most, at_best(weights(strength)));
  // Levels themselves too: with more simulations the curve may bend to them.
  for (Eigen::Index k = 0; k < std::ssize(at_); ++k)
    most = std::max(most, at_best(Eigen::VectorXd::Unit(std::ssize(at_), k)));
  return most;
}

PairSignature::PairSignature(const Signature& first, const Signature& second)
    : first_(&first), second_(&second), cross_(first.changes_.transpose() * second.changes_) {
  const double both = std::min(first.of_nothing_, second.of_nothing_);  // what is exact shares none
  shared_ = Eigen::MatrixXd::Constant(cross_.rows(), cross_.cols(), both);
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

/// Strengths that are equally likely beforehand: a Cauchy distribution is uniform in the angle whose tangent
/// the strength is.
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
  found.could_be = found.log_evidence + signature.most_likely_at_best(strength) - found.gain / 2;
  // Flat in the strength: each of the steps by its width.
  const Eigen::ArrayXd weight = relative * (1 + (strength / prior.typical).square());
  const double mean = (weight * strength).sum() / weight.sum();
  found.error = std::sqrt((weight * (strength - mean).square()).sum() / weight.sum());
  return found;
}

}  // namespace shakedown
