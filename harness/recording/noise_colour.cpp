// SPDX-License-Identifier: MIT
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "local_polynomial.hpp"
#include "noise.hpp"
#include "nothing.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

/// With fewer frames a period the motion's own kinks have the colour of noise with a memory.
constexpr double frames_for_colour = 40;

constexpr std::size_t lags = 1 + colour_lags;
using Autocovariance = std::array<double, lags>;

/// Returns what is left of a series when a local polynomial is taken out, m. Frames next to a landing, where
/// it fails and the energy over one length of the filter exceeds `cut` times the usual one, are left out
/// (NaN).
std::vector<double> rough_part(const NoiseSeries& series, const Eigen::VectorXd& filter, double cut) {
  const std::vector<double>& x = *series.x;
  const std::size_t half = static_cast<std::size_t>(filter.size() / 2);
  std::vector<double> rough(x.size(), nothing);
  for (std::size_t i = half; i + half < x.size(); ++i) {
    double sum = 0;
    bool whole = series.moving[i];
    for (std::size_t j = i - half; j <= i + half; ++j) {
      whole = whole && (j == i - half || series.neighbour[j]);
      sum += filter[static_cast<Eigen::Index>(j - (i - half))] * x[j];
    }
    if (whole) rough[i] = sum;
  }
  std::vector<double> energy(x.size(), nothing);
  for (std::size_t i = half; i + half < x.size(); ++i) {
    double sum = 0;
    for (std::size_t j = i - half; j <= i + half; ++j)
      sum += std::isfinite(rough[j]) ? rough[j] * rough[j] : 0;
    if (std::isfinite(rough[i])) energy[i] = sum;
  }
  const double usual = median(finite_of(energy));
  for (std::size_t i = 0; i < x.size(); ++i)
    if (energy[i] > cut * usual) rough[i] = nothing;
  return rough;
}

/// Builds the filter that takes out a local polynomial (over 40 ms, and over nine frames or what the order
/// needs): one at the frame itself, less the weights of the fit.
Eigen::VectorXd roughness_filter(double interval, int order) {
  const int half = std::max({4, order / 2 + 2, static_cast<int>(std::lround(0.02 / interval))});
  const Eigen::MatrixXd powers = powers_of(even_places(half), order);
  const Eigen::MatrixXd normal = powers.transpose() * powers;
  Eigen::VectorXd filter = -powers * normal.ldlt().solve(Eigen::VectorXd::Unit(order, 0));
  filter[half] += 1;
  return filter;
}

void add_autocovariance(const std::vector<double>& rough, Autocovariance& sum, Autocovariance& count) {
  for (std::size_t lag = 0; lag < lags; ++lag)
    for (std::size_t i = 0; i + lag < rough.size(); ++i)
      if (std::isfinite(rough[i]) && std::isfinite(rough[i + lag]))
        sum[lag] += rough[i] * rough[i + lag], ++count[lag];
}

/// Computes the autocovariance, at a lag, of the rough part of first-order noise of correlation r and unit
/// variance.
class RoughNoise {
 public:
  explicit RoughNoise(const Eigen::VectorXd& filter)
      : length_(filter.size()), own_(Eigen::VectorXd::Zero(2 * filter.size() - 1)) {
    for (Eigen::Index i = 0; i < length_; ++i)
      for (Eigen::Index j = 0; j < length_; ++j) own_[i - j + length_ - 1] += filter[i] * filter[j];
  }
  /// Returns r to the power of each number of frames that a lag and the filter span.
  Eigen::VectorXd powers(double r) const {
    Eigen::VectorXd all(length_ + std::max(length_, static_cast<Eigen::Index>(lags)));
    for (Eigen::Index k = 0; k < all.size(); ++k) all[k] = std::pow(r, static_cast<double>(k));
    return all;
  }
  double autocovariance(const Eigen::VectorXd& powers_of_r, Eigen::Index lag) const {
    double value = 0;
    for (Eigen::Index d = 0; d < own_.size(); ++d)
      value += own_[d] * powers_of_r[std::abs(lag + d - (length_ - 1))];
    return value;
  }
  /// Returns the energy over one length of the filter that lies four standard deviations above the mean,
  /// relative to the mean. Cutting lower would take the colour away with the landings.
  double energy_cut(double r) const {
    const Eigen::VectorXd powers_of_r = powers(r);
    const double variance = autocovariance(powers_of_r, 0), n = static_cast<double>(length_);
    double sum = n * variance * variance;
    for (Eigen::Index lag = 1; lag < length_; ++lag) {
      const double c = autocovariance(powers_of_r, lag);
      sum += 2 * static_cast<double>(length_ - lag) * c * c;
    }
    return 1 + 4 * std::sqrt(2 * sum) / (n * variance);
  }

 private:
  Eigen::Index length_;
  Eigen::VectorXd own_;  // the filter's autocorrelation at offsets 1 - length ... length - 1
};

/// Returns the r of first-order noise, r_k = r^k, whose rough part has the autocovariance that was measured;
/// 0 where it is within the error.
double correlation_of(const Autocovariance& sum, const Autocovariance& count, const RoughNoise& rough) {
  if (!(count[0] > 200) || !(sum[0] > 0)) return 0;
  const auto misfit = [&](double r) {
    const Eigen::VectorXd powers_of_r = rough.powers(r);
    const double variance = rough.autocovariance(powers_of_r, 0);
    double total = 0;
    for (std::size_t lag = 1; lag < lags; ++lag) {
      if (count[lag] == 0) continue;
      const double off = sum[lag] / count[lag] * count[0] / sum[0] -
                         rough.autocovariance(powers_of_r, static_cast<Eigen::Index>(lag)) / variance;
      total += off * off;
    }
    return total;
  };
  double best = 0;
  for (double r = -0.6; r <= 0.95; r += 0.05)
    if (misfit(r) < misfit(best)) best = r;
  const double coarse = best;
  for (double r = coarse - 0.04; r < coarse + 0.045; r += 0.01)
    if (misfit(r) < misfit(best)) best = r;
  return std::abs(best) < 5 / std::sqrt(count[0]) ? 0 : best;
}

std::array<double, colour_lags> powers_of(double r) {
  std::array<double, colour_lags> correlation{};
  for (int k = 1; k <= colour_lags && r != 0; ++k)
    correlation[static_cast<std::size_t>(k - 1)] = std::pow(r, k);
  return correlation;
}

}  // namespace

std::array<double, colour_lags> colour_of(const std::vector<NoiseSeries>& series) {
  int order = NoiseSeries{}.order;
  for (const NoiseSeries& one : series) {
    if (one.order == 0 || one.frames_per_period < frames_for_colour) return {};
    order = std::max(order, one.order);
  }
  if (series.empty()) return {};
  const Eigen::VectorXd filter = roughness_filter(series.front().interval, order);
  const bool any_longer = std::any_of(series.begin(), series.end(), [&](const NoiseSeries& one) {
    return static_cast<Eigen::Index>(one.x->size()) >= filter.size();
  });
  if (!any_longer) return {};  // no frame has a rough part, as in a film of some milliseconds
  const RoughNoise rough(filter);
  double cut = 4, r = 0;  // generous first, then what the colour found allows
  for (int pass = 0; pass < 3; ++pass) {
    Autocovariance sum{}, count{};
    for (const NoiseSeries& one : series) {
      Autocovariance own_sum{}, own_count{};
      add_autocovariance(rough_part(one, filter, cut), own_sum, own_count);
      for (std::size_t lag = 0; lag < lags && own_sum[0] > 0; ++lag)
        sum[lag] += own_sum[lag] / own_sum[0] * own_count[0], count[lag] += own_count[lag];
    }
    r = correlation_of(sum, count, rough);
    cut = rough.energy_cut(r);
  }
  return powers_of(r);
}

}  // namespace shakedown
