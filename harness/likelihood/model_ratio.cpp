// SPDX-License-Identifier: MIT
#include "model_ratio.hpp"

#include <algorithm>
#include <cmath>

#include "outside.hpp"

namespace shakedown {

namespace {

/// Squares per feature that count as spread: more is a mean that is off, which no spread explains. An
/// assumption; side walls of 0.11 instead of 0.76 make it 1.33 times as much.
constexpr double widest = 1.5;

double by_spread(const OtherModel& other, const FirstModel& first, double chi2_per_feature) {
  Eigen::MatrixXd free(first.residual.size(), first.free.cols() + 1);
  free << first.free, other.change;
  const double share = std::min(1.0, widest / std::max(1e-300, chi2_per_feature)),
               fall = Outside(free, first.variance)(first.residual).squaredNorm() -
                      Outside(free, other.variance)(first.residual).squaredNorm();
  return (share * fall - (other.variance / first.variance).log().sum()) / 2;
}

}  // namespace

double log_likelihood_ratio(const OtherModel& other, const FirstModel& first) {
  const double chi2_per_feature = Outside(first.free, first.variance)(first.residual).squaredNorm() /
                                  static_cast<double>(first.residual.size()),
               spread = by_spread(other, first, chi2_per_feature);
  const Outside outside(first.free, other.variance);
  const Eigen::VectorXd change = outside(other.change), residual = outside(first.residual);
  const double of_first = first.noise * (first.variance / other.variance).mean(),
               noise = other.noise + of_first, square = change.squaredNorm(),
               a = std::max(0.0, square - noise), b = change.dot(residual) - of_first;
  const double mean = a > 0 ? a * (b - a / 2) / (a + noise * std::max(1.0, chi2_per_feature)) : 0;
  const double kappa = (outside(first.simulations.transpose()).transpose() * change).squaredNorm() /
                       static_cast<double>(first.simulations.rows()) / std::max(1e-300, square);
  return (mean + spread) / std::max(1.0, kappa);
}

}  // namespace shakedown
