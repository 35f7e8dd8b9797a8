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

/// Columns without what the free ones take up, in these variances.
class Outside {
 public:
  Outside(const Eigen::MatrixXd& free, const Eigen::ArrayXd& variance)
      : scale_(variance.rsqrt()), free_(scale_.matrix().asDiagonal() * free) {
    // A parameter that nothing tells of stays where it is.
    constexpr double open = 1e-9;
    Eigen::MatrixXd normal = free_.transpose() * free_;
    normal.diagonal().array() += open;
    root_.compute(normal);
  }
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const {
    const Eigen::MatrixXd scaled = scale_.matrix().asDiagonal() * columns;
    if (free_.cols() == 0) return scaled;
    return scaled - free_ * root_.solve(free_.transpose() * scaled);
  }

 private:
  Eigen::ArrayXd scale_;
  Eigen::MatrixXd free_;
  Eigen::LLT<Eigen::MatrixXd> root_;
};

/// As the middle half of the values has it: a few simulations lie far out, the one that was filmed rarely
/// does.
/// Squares per feature that count as spread: more is a mean that is off, which no spread explains. Side walls
/// of 0.11 instead of 0.76 make it 1.33 times as much.
constexpr double widest = 1.5;

/// ln of the likelihood that the spread at a level has over that of nothing, what the change takes up left
/// out.
double log_likelihood_of_spread(const SignatureLevel& level, const SignatureResidual& without,
                                const Eigen::ArrayXd& without_it, double chi2_per_feature) {
  Eigen::MatrixXd free(level.change.size(), without.free.cols() + 1);
  if (without.free.cols() > 0) free.leftCols(without.free.cols()) = without.free;
  free.rightCols(1) = level.change;
  const Eigen::ArrayXd there = level.variance.array();
  const double of_spread = std::min(1.0, widest / std::max(1e-300, chi2_per_feature));
  return (of_spread * (Outside(free, without_it)(without.residual).squaredNorm() -
                       Outside(free, there)(without.residual).squaredNorm()) -
          (there / without_it).log().sum()) /
         2;
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
  const auto variance_of = [&](const Eigen::VectorXd& said) -> Eigen::ArrayXd {
    return said.size() > 0 ? said.array() : Eigen::ArrayXd::Ones(features).eval();
  };
  const Eigen::ArrayXd without_it = variance_of(without.variance);
  const Eigen::MatrixXd none(features, 0), free = without.free.cols() > 0 ? without.free : none;
  const auto weighed_by = [&](double strength, const Eigen::ArrayXd& variance) {
    const Outside outside(free, variance);
    const Eigen::MatrixXd shapes = outside(shapes_), residual = outside(without.residual);
    Weighed w{strength, shapes.transpose() * shapes, {}, shapes.transpose() * residual};
    const auto share = [&](const Eigen::ArrayXd& of) { return (of / variance).mean(); };
    Eigen::VectorXd noise_here(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::VectorXd& said = levels[static_cast<std::size_t>(k)].variance;
      noise_here[k] = noise[k] * share(said.size() > 0 ? said.array() : without_it);
    }
    const double nothing_here = of_nothing * share(without_it);
    w.noise = of_levels * noise_here.asDiagonal() * of_levels.transpose() +
              nothing_here * shared * shared.transpose();
    w.overlap -= nothing_here * shared;
    if (without.simulations.rows() > 0) {
      // Near nothing as at a level.
      const Eigen::VectorXd change = shapes * weights(strength != 0 ? strength : levels.front().strength);
      w.kappa = std::max(1.0, (outside(without.simulations.transpose()).transpose() * change).squaredNorm() /
                                  static_cast<double>(without.simulations.rows()) /
                                  std::max(1e-300, change.squaredNorm()));
    }
    return w;
  };
  weighed_.push_back(weighed_by(0, without_it));
  chi2_per_feature_ =
      Outside(free, without_it)(without.residual).squaredNorm() / static_cast<double>(features);
  for (const SignatureLevel& level : levels) {
    if (level.variance.size() == 0) continue;
    weighed_.push_back(weighed_by(level.strength, level.variance.array()));
    weighed_.back().spread = log_likelihood_of_spread(level, without, without_it, chi2_per_feature_);
  }
  std::sort(weighed_.begin(), weighed_.end(),
            [](const Weighed& a, const Weighed& b) { return a.strength < b.strength; });
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

double Signature::Weighed::log_likelihood(const Eigen::VectorXd& v, double chi2_per_feature) const {
  const double of_noise = v.dot(noise * v), of_change = std::max(0.0, v.dot(square * v) - of_noise);
  if (!(of_change > 0)) return spread / kappa;
  return (spread + of_change * (overlap.dot(v) - of_change / 2) /
                       (of_change + of_noise * std::max(1.0, chi2_per_feature))) /
         kappa;
}

double Signature::log_likelihood(double strength) const {
  const Eigen::VectorXd v = weights(strength);
  const auto above = std::find_if(weighed_.begin(), weighed_.end(),
                                  [&](const Weighed& w) { return w.strength >= strength; });
  if (above == weighed_.begin()) return above->log_likelihood(v, chi2_per_feature_);
  const auto below = above - 1;
  if (above == weighed_.end()) return below->log_likelihood(v, chi2_per_feature_);
  const double along = (strength - below->strength) / (above->strength - below->strength);
  return (1 - along) * below->log_likelihood(v, chi2_per_feature_) +
         along * above->log_likelihood(v, chi2_per_feature_);
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
  // Flat in the strength: each of the steps by its width.
  const Eigen::ArrayXd weight = relative * (1 + (strength / prior.typical).square());
  const double mean = (weight * strength).sum() / weight.sum();
  found.error = std::sqrt((weight * (strength - mean).square()).sum() / weight.sum());
  return found;
}

}  // namespace shakedown
