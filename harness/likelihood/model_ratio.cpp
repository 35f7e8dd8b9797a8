// SPDX-License-Identifier: MIT
#include "model_ratio.hpp"

#include <algorithm>
#include <cmath>

#include "outside.hpp"

namespace shakedown {

namespace {

/// Most squares per feature that count as spread: more is a mean that is off, which no spread explains. An
/// assumption; side walls of restitution 0.11 instead of 0.76 make it 1.33 times as much.
constexpr double widest = 1.5;

/// Returns -2 ln of the likelihood of squares that sum to `squares` by unit variances, all of them larger by
/// the factor that suits best. The prior of that factor hardly moves it, because features are many.
double deviance(double squares, double features, double codes_differ) {
  const double factor = codes_differ > 1 ? std::max(1.0, squares / features) : 1.0,
               away = codes_differ > 1 ? 2 * (factor - 1) / (codes_differ - 1) : 0;
  return squares / factor + features * std::log(factor) + away * away;
}

double by_spread(const OtherModel& other, const FirstModel& first, double chi2_per_feature) {
  Eigen::MatrixXd free(first.residual.size(), first.free.cols() + 1);
  free << first.free, other.change;
  const double share = std::min(1.0, widest / std::max(1e-300, chi2_per_feature)),
               features = static_cast<double>(first.residual.size());
  const auto deviance_by = [&](const Eigen::ArrayXd& variance) {
    return deviance(share * Outside(free, variance)(first.residual).squaredNorm(), features,
                    first.codes_differ);
  };
  return (deviance_by(first.variance) - deviance_by(other.variance) -
          (other.variance / first.variance).log().sum()) /
         2;
}

double chi2_per_feature_of(const FirstModel& first) {
  return Outside(first.free, first.variance)(first.residual).squaredNorm() /
         static_cast<double>(first.residual.size());
}

/// Returns the kappa of log_likelihood_ratio(). `change`: less what the free parameters take up.
double kappa(const Outside& outside, const Eigen::VectorXd& change, const FirstModel& first) {
  const double along = (outside(first.simulations.transpose()).transpose() * change).squaredNorm() /
                       static_cast<double>(first.simulations.rows());
  return std::max(1.0, along / std::max(1e-300, change.squaredNorm()));
}

}  // namespace

double log_likelihood_ratio(const OtherModel& other, const FirstModel& first) {
  const double chi2_per_feature = chi2_per_feature_of(first),
               spread = by_spread(other, first, chi2_per_feature);
  const Outside outside(first.free, other.variance);
  const Eigen::VectorXd change = outside(other.change), residual = outside(first.residual);
  const double of_first = first.noise * (first.variance / other.variance).mean(),
               noise = other.noise + of_first, square = change.squaredNorm(),
               a = std::max(0.0, square - noise), b = change.dot(residual) - of_first;
  const double mean = a > 0 ? a * (b - a / 2) / (a + noise * std::max(1.0, chi2_per_feature)) : 0;
  return (mean + spread) / kappa(outside, change, first);
}

}  // namespace shakedown
