// SPDX-License-Identifier: MIT
#include "decay.hpp"

#include <cmath>
#include <numbers>

#include "least_squares.hpp"

namespace shakedown {

namespace {

constexpr double last_time = 8.0;  // s

Decay::Linear straight_line(const Eigen::VectorXd& time, const Eigen::VectorXd& height) {
  Eigen::MatrixXd columns(time.size(), 2);
  columns << Eigen::VectorXd::Ones(time.size()), time;
  const LeastSquares fit = least_squares(columns, height);
  return {fit.coefficients[0], fit.errors[0], fit.coefficients[1], fit.errors[1], fit.rms};
}

/// Fits an exponential by Gauss-Newton from the straight line through the logarithms.
Decay::Exponential exponential(const Eigen::VectorXd& time, const Eigen::VectorXd& height) {
  const Decay::Linear logarithm = straight_line(time, height.array().log());
  double amplitude = std::exp(logarithm.intercept), rate = -logarithm.slope;
  LeastSquares step;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Eigen::ArrayXd shape = (-rate * time.array()).exp();
    Eigen::MatrixXd columns(time.size(), 2);
    columns << shape.matrix(), (-amplitude * time.array() * shape).matrix();
    step = least_squares(columns, height - (amplitude * shape).matrix());
    amplitude += step.coefficients[0];
    rate += step.coefficients[1];
    if (std::abs(step.coefficients[0]) < 1e-14 * amplitude) break;
  }
  const Eigen::ArrayXd misfit = height.array() - amplitude * (-rate * time.array()).exp();
  return {amplitude, step.errors[0], rate, step.errors[1], std::sqrt(misfit.square().mean())};
}

}  // namespace

std::vector<Peak> peaks_of_the_decay(const std::vector<Peak>& peaks, double small) {
  std::vector<Peak> kept;
  for (const Peak& peak : peaks) {
    if (std::abs(peak.position) < small || peak.time >= last_time) break;
    kept.push_back(peak);
  }
  return kept;
}

double first_small_peak(const std::vector<Peak>& peaks, double small) {
  for (const Peak& peak : peaks)
    if (std::abs(peak.position) < small) return peak.time;
  return absent;
}

Decay decay_of(const std::vector<Peak>& peaks, double small) {
  return decay_through(peaks_of_the_decay(peaks, small));
}

Decay decay_through(const std::vector<Peak>& kept) {
  const Eigen::Index count = static_cast<Eigen::Index>(kept.size());
  Eigen::VectorXd time(count), height(count);
  for (Eigen::Index n = 0; n < count; ++n) {
    time[n] = kept[static_cast<std::size_t>(n)].time;
    height[n] = std::abs(kept[static_cast<std::size_t>(n)].position);
  }
  Decay decay;
  decay.peaks = static_cast<int>(count);
  if (count >= 2) {
    decay.linear = straight_line(time, height);
    decay.exponential = exponential(time, height);
  }
  if (count >= 3) {
    Eigen::MatrixXd columns(count, 3);
    columns << Eigen::VectorXd::Ones(count), time, time.cwiseAbs2();
    const LeastSquares fit = least_squares(columns, height);
    decay.curvature = 2 * fit.coefficients[2];
    decay.curvature_error = 2 * fit.errors[2];
  }
  return decay;
}

std::vector<HalfPeriodDamping> damping_of(double release, const std::vector<Peak>& peaks) {
  std::vector<HalfPeriodDamping> damping;
  double before = std::abs(release);
  for (const Peak& peak : peaks) {
    const double after = std::abs(peak.position), decrement = std::log(before / after);
    if (before > 0)
      damping.push_back({(before + after) / 2, -std::expm1(-4 * decrement),
                         decrement / std::hypot(std::numbers::pi, decrement)});
    before = after;
  }
  return damping;
}

}  // namespace shakedown
