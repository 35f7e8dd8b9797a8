// SPDX-License-Identifier: MIT
#include "features.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {

/// Returns the standard deviation, m, of a weighted sum of frames whose noise is correlated over a few
/// frames.
double noise_of(const FeaturePlan::Reading& reading, const NoiseFound& noise) {
  double variance = 0;
  for (std::size_t i = 0; i < reading.weight.size(); ++i) {
    variance += reading.weight[i] * reading.weight[i];
    for (std::size_t lag = 1; lag <= colour_lags && i + lag < reading.weight.size(); ++lag)
      variance += 2 * noise.correlation[lag - 1] * reading.weight[i] * reading.weight[i + lag];
  }
  return noise.standard_deviation * std::sqrt(std::max(variance, 0.0));
}

/// Returns the weights that give the value at `middle` (s) of a parabola through the frames (least squares).
std::vector<double> level_weights(const std::vector<double>& time, double middle) {
  Eigen::MatrixXd basis(static_cast<Eigen::Index>(time.size()), 3);
  const double half = std::max(1e-9, (time.back() - time.front()) / 2);
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    const double u = (time[static_cast<std::size_t>(i)] - middle) / half;
    basis.row(i) << 1, u, u * u;
  }
  const Eigen::Matrix3d normal = basis.transpose() * basis;
  const Eigen::VectorXd weight = basis * normal.ldlt().solve(Eigen::Vector3d(1, 0, 0));
  return {weight.data(), weight.data() + weight.size()};
}

/// Returns until when a run tells something, s: one and a quarter periods after the last frame farther than
/// `rest` from where the box ends up, or farther than one and a half times as far as it still swings there,
/// but not than 5 `rest` (a layer pressed on one wall by a steady force swings on without loss).
double end_of_motion(const Measurement::Run& measurement) {
  // 4 mm, 1 s and 2 s of the paper's damper.
  constexpr double of_the_release = 4e-3 / 0.1075, periods_after = 1.23, periods_at_the_end = 2.46;
  const MeasuredRun& run = measurement.recorded;
  const std::vector<double>& x_box = measurement.audit.x_box;
  const double rest = of_the_release * measurement.excursion;
  std::vector<double> late;
  for (std::size_t i = 0; i < run.time.size(); ++i)
    if (run.time[i] > run.time.back() - periods_at_the_end * measurement.period && std::isfinite(x_box[i]))
      late.push_back(x_box[i]);
  if (late.empty()) return 0;
  const auto [lowest, highest] = std::minmax_element(late.begin(), late.end());
  const double middle = (*lowest + *highest) / 2, swing = (*highest - *lowest) / 2;
  double end = 0;
  for (std::size_t i = 0; i < run.time.size(); ++i)
    if (std::abs(x_box[i] - middle) > std::max(rest, std::min(1.5 * swing, 5 * rest))) end = run.time[i];
  return std::min(end + periods_after * measurement.period, run.time.back());
}

/// Of one observable: a film of five hundred periods is looked at in bins of a seventh of one.
constexpr double most_bins = 600;

struct Bins {
  double width = 0;  ///< s, of equal bins from time 0 to plan.end
  std::size_t frames = 0;
};

void add_features(Observable observable, const std::vector<double>& time, const std::vector<double>& x,
                  const NoiseFound& noise, const Bins& bins, FeaturePlan& plan) {
  const double bin = bins.width;
  std::size_t i = 0;
  for (int k = 0; (k + 1) * bin <= plan.end + 1e-9; ++k) {
    const double middle = (k + 0.5) * bin;
    FeaturePlan::Reading reading;
    for (; i < time.size() && time[i] < (k + 1) * bin - 1e-9; ++i)
      if (time[i] >= k * bin - 1e-9 && std::isfinite(x[i])) reading.time.push_back(time[i]);
    const bool spans = !reading.time.empty() && reading.time.front() < middle - bin / 5 &&
                       reading.time.back() > middle + bin / 5;
    if (reading.time.size() < std::max<std::size_t>(4, bins.frames / 2) || !spans) continue;
    reading.weight = level_weights(reading.time, middle);
    plan.features.push_back({observable, middle, noise_of(reading, noise)});
    plan.readings.push_back(std::move(reading));
  }
}

}  // namespace

FeaturePlan plan_features(const Measurement::Run& measurement, Observed observed) {
  const MeasuredRun& run = measurement.recorded;
  const RunAudit& audit = measurement.audit;
  FeaturePlan plan;
  plan.end = measurement.shaken ? run.time.back() : end_of_motion(measurement);
  const double interval = audit.frame_interval > 0 ? audit.frame_interval : 1 / run.frame_rate;
  // Slow cameras get wider bins, so that a bin has frames enough for a parabola.
  const double width = std::max({bin_of_a_period * measurement.period, 8 * interval, plan.end / most_bins});
  const Bins bins{width, static_cast<std::size_t>(width / interval)};
  add_features(Observable::box, run.time, audit.x_box, audit.box, bins, plan);
  if (run.has_com() && observed == Observed::all)
    add_features(Observable::centre, run.time, audit.x_com, audit.com, bins, plan);
  return plan;
}

Eigen::VectorXd features_on_frames(const FeaturePlan& plan, const std::vector<double>& time,
                                   const std::vector<double>& box, const std::vector<double>& centre) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(plan.features.size()));
  for (std::size_t f = 0; f < plan.features.size(); ++f) {
    const std::vector<double>& x = plan.features[f].observable == Observable::box ? box : centre;
    const FeaturePlan::Reading& reading = plan.readings[f];
    std::size_t frame = static_cast<std::size_t>(
        std::lower_bound(time.begin(), time.end(), reading.time.front()) - time.begin());
    double sum = 0;
    for (std::size_t i = 0; i < reading.time.size(); ++i) {
      while (time[frame] < reading.time[i]) ++frame;
      sum += reading.weight[i] * x[frame];
    }
    values[static_cast<Eigen::Index>(f)] = sum;
  }
  return values;
}

Eigen::VectorXd measured_features(const FeaturePlan& plan, const Measurement::Run& run) {
  return features_on_frames(plan, run.recorded.time, run.audit.x_box, run.audit.x_com);
}

Eigen::VectorXd simulated_features(const FeaturePlan& plan, const Recording& recording) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(plan.features.size()));
  const double start = recording.time.front();
  const double rate = static_cast<double>(recording.time.size() - 1) / (recording.time.back() - start);
  for (std::size_t f = 0; f < plan.features.size(); ++f) {
    const std::vector<double>& x =
        plan.features[f].observable == Observable::box ? recording.x_box : recording.x_com;
    const FeaturePlan::Reading& reading = plan.readings[f];
    double sum = 0;
    for (std::size_t i = 0; i < reading.time.size(); ++i) {
      const double place =
          std::clamp((reading.time[i] - start) * rate, 0.0, static_cast<double>(x.size() - 1));
      const auto k = std::min(static_cast<std::size_t>(place), x.size() - 2);
      const double part = place - static_cast<double>(k);
      sum += reading.weight[i] * (part == 0 ? x[k] : x[k] + part * (x[k + 1] - x[k]));
    }
    values[static_cast<Eigen::Index>(f)] = sum;
  }
  return values;
}

void simulate_until(Setup& setup, double end) {
  constexpr double least = 0.5;  // s
  setup.run.duration = std::max(least, end + simulated_beyond);
  setup.run.sample_rate = usual_frame_rate;
}

}  // namespace shakedown
