// SPDX-License-Identifier: MIT
#include "noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// 4th differences of neighbouring frames: a smooth motion cancels, white noise of deviation s comes out with
/// s sqrt(70).
std::vector<double> fourth_differences(const std::vector<double>& x, const std::vector<char>& neighbour) {
  std::vector<double> differences(x.size(), nothing);
  for (std::size_t i = 2; i + 2 < x.size(); ++i)
    if (neighbour[i - 1] && neighbour[i] && neighbour[i + 1] && neighbour[i + 2])
      differences[i] = x[i - 2] - 4 * x[i - 1] + 6 * x[i] - 4 * x[i + 1] + x[i + 2];
  return differences;
}

std::vector<double> finite_of(const std::vector<double>& values) {
  std::vector<double> kept;
  for (const double value : values)
    if (std::isfinite(value)) kept.push_back(value);
  return kept;
}

constexpr std::size_t lags = 1 + colour_lags;
using Autocovariance = std::array<double, lags>;

/// What is left of a series when a local cubic over 40 ms is taken out: noise above 25 Hz. Frames next to a
/// landing, where the cubic fails and the energy over 40 ms exceeds `cut` times the usual one, are left out
/// (NaN).
std::vector<double> rough_part(const std::vector<double>& x, const std::vector<char>& neighbour,
                               const Eigen::VectorXd& filter, double cut) {
  const std::size_t half = static_cast<std::size_t>(filter.size() / 2);
  std::vector<double> rough(x.size(), nothing);
  for (std::size_t i = half; i + half < x.size(); ++i) {
    double sum = 0;
    bool whole = true;
    for (std::size_t j = i - half; j <= i + half; ++j) {
      whole = whole && (j == i - half || neighbour[j]);
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

/// The filter that takes a local cubic out: 1 at the frame itself less the weights of the fit.
Eigen::VectorXd roughness_filter(double interval) {
  const int half = std::max(4, static_cast<int>(std::lround(0.02 / interval))), n = 2 * half + 1;
  Eigen::MatrixXd powers(n, 4);
  for (int i = 0; i < n; ++i)
    for (int power = 0; power < 4; ++power)
      powers(i, power) = std::pow(static_cast<double>(i - half) / half, power);
  const Eigen::MatrixXd normal = powers.transpose() * powers;
  Eigen::VectorXd filter = -powers * normal.ldlt().solve(Eigen::Vector4d::Unit(0));
  filter[half] += 1;
  return filter;
}

void add_autocovariance(const std::vector<double>& rough, Autocovariance& sum, Autocovariance& count) {
  for (std::size_t lag = 0; lag < lags; ++lag)
    for (std::size_t i = 0; i + lag < rough.size(); ++i)
      if (std::isfinite(rough[i]) && std::isfinite(rough[i + lag]))
        sum[lag] += rough[i] * rough[i + lag], ++count[lag];
}

/// Autocovariance, at a lag, of the rough part of first-order noise of correlation r and unit variance.
class RoughNoise {
 public:
  explicit RoughNoise(const Eigen::VectorXd& filter)
      : length_(filter.size()), own_(Eigen::VectorXd::Zero(2 * filter.size() - 1)) {
    for (Eigen::Index i = 0; i < length_; ++i)
      for (Eigen::Index j = 0; j < length_; ++j) own_[i - j + length_ - 1] += filter[i] * filter[j];
  }
  double autocovariance(double r, Eigen::Index lag) const {
    double value = 0;
    for (Eigen::Index d = 0; d < own_.size(); ++d)
      value += own_[d] * std::pow(r, static_cast<double>(std::abs(lag + d - (length_ - 1))));
    return value;
  }
  /// Energy over one length of the filter, four standard deviations above the mean, relative to the mean.
  /// Cutting lower would take the colour away with the landings.
  double energy_cut(double r) const {
    const double variance = autocovariance(r, 0), n = static_cast<double>(length_);
    double sum = n * variance * variance;
    for (Eigen::Index lag = 1; lag < length_; ++lag) {
      const double c = autocovariance(r, lag);
      sum += 2 * static_cast<double>(length_ - lag) * c * c;
    }
    return 1 + 4 * std::sqrt(2 * sum) / (n * variance);
  }

 private:
  Eigen::Index length_;
  Eigen::VectorXd own_;  // the filter's autocorrelation at offsets 1 - length ... length - 1
};

/// The r of first-order noise, r_k = r^k, whose rough part has the autocovariance that was measured; 0 where
/// it is within the error.
double correlation_of(const Autocovariance& sum, const Autocovariance& count, const RoughNoise& rough) {
  if (!(count[0] > 200) || !(sum[0] > 0)) return 0;
  const auto misfit = [&](double r) {
    double total = 0;
    for (std::size_t lag = 1; lag < lags; ++lag) {
      const double off = sum[lag] / count[lag] * count[0] / sum[0] -
                         rough.autocovariance(r, static_cast<Eigen::Index>(lag)) / rough.autocovariance(r, 0);
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

/// Standard deviation of one frame from that of the differences, given the colour.
double deviation_from(double of_differences, const std::array<double, colour_lags>& correlation) {
  constexpr double overlap[] = {70, -56, 28, -8, 1};  // autocorrelation of the filter 1 -4 6 -4 1
  double gain = overlap[0];
  for (std::size_t k = 1; k < 5; ++k) gain += 2 * overlap[k] * correlation[k - 1];
  return of_differences / std::sqrt(std::max(gain, 1.0));
}

/// The step of the recorded numbers when it is large enough to matter beside the noise.
double quantum_of(const std::vector<double>& x, double deviation) {
  std::vector<double> sorted = finite_of(x);
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> steps;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > 1e-12) steps.push_back(sorted[i] - sorted[i - 1]);
  if (steps.size() < 10) return 0;
  const double step = median(steps);
  const auto small = static_cast<double>(
      std::count_if(steps.begin(), steps.end(), [&](double s) { return s < 0.9 * step; }));
  return step > 0.3 * deviation && small < 0.01 * static_cast<double>(steps.size()) ? step : 0;
}

}  // namespace

std::array<double, colour_lags> colour_of(const std::vector<NeighbouredSeries>& series, double interval) {
  const Eigen::VectorXd filter = roughness_filter(interval);
  const RoughNoise rough(filter);
  double cut = 4, r = 0;  // generous first, then what the colour found allows
  for (int pass = 0; pass < 3; ++pass) {
    Autocovariance sum{}, count{};
    for (const NeighbouredSeries& one : series) {
      Autocovariance own_sum{}, own_count{};
      add_autocovariance(rough_part(*one.x, one.neighbour, filter, cut), own_sum, own_count);
      for (std::size_t lag = 0; lag < lags && own_sum[0] > 0; ++lag)
        sum[lag] += own_sum[lag] / own_sum[0] * own_count[0], count[lag] += own_count[lag];
    }
    r = correlation_of(sum, count, rough);
    cut = rough.energy_cut(r);
  }
  return powers_of(r);
}

void set_deviation(const NeighbouredSeries& series, NoiseFound& noise) {
  const double of_differences = robust_deviation(finite_of(fourth_differences(*series.x, series.neighbour)));
  noise.standard_deviation = deviation_from(of_differences, noise.correlation);
  noise.quantum = quantum_of(*series.x, noise.standard_deviation);
  // Rounding to steps q adds q^2/12, which 4th differences see while the motion is fast and miss while it is
  // slow.
  noise.standard_deviation = std::max(noise.standard_deviation, noise.quantum / std::sqrt(12.0));
  if (!(noise.standard_deviation > 1e-9)) noise.standard_deviation = 1e-9;  // simulated without a camera
}

double white_deviation(const NeighbouredSeries& series) {
  return robust_deviation(finite_of(fourth_differences(*series.x, series.neighbour))) / std::sqrt(70.0);
}

}  // namespace shakedown
