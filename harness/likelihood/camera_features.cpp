// SPDX-License-Identifier: MIT
#include "camera_features.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "camera.hpp"
#include "nuisance.hpp"
#include "parameter_knobs.hpp"
#include "setup_file.hpp"

namespace shakedown {

std::vector<MeasuredFeatures> features_with_camera(const Measurement& measurement, KnownEffects known) {
  std::vector<MeasuredFeatures> list = features_of(measurement);
  const std::vector<CameraNuisance> nuisances = camera_nuisances(measurement, known);
  for (std::size_t r = 0; r < list.size(); ++r) {
    const Measurement::Run& run = measurement.runs[r];
    const Recording recording{run.recorded.time, run.audit.x_box, run.audit.x_com};
    for (const CameraParameter& parameter : camera_parameters(known)) {
      if (parameter.inverse_square) continue;
      Recording change = derivative(recording, parameter);
      for (std::vector<double>* x : {&change.x_box, &change.x_com})
        for (double& at : *x)
          if (!std::isfinite(at)) at = 0;  // beside a gap, where no bin looks
      list[r].by_camera[parameter.path] =
          features_on_frames(list[r].plan, recording.time, change.x_box, change.x_com);
    }
    for (const CameraNuisance& nuisance : nuisances) {
      if (!nuisance.each_run || !(nuisance.deviation_of[r] > 0)) continue;
      list[r].own.conservativeResize(list[r].values.size(), list[r].own.cols() + 1);
      list[r].own.rightCols(1) = nuisance.deviation_of[r] * list[r].by_camera.at(nuisance.key);
    }
  }
  return list;
}

namespace {

/// Returns how late all runs may be seen together, s, as a standard deviation. A frame's time is that of one
/// of its rows, where a camera says so the first (Android Camera2, SENSOR_TIMESTAMP), so that the middle of a
/// picture of 0.4 m is read by half of the shutter's time later. Returns 0 where the clock or the shutter is
/// known exactly.
double late_by_rows(const Setup& setup, const std::vector<CameraNuisance>& nuisances, KnownEffects known,
                    const std::optional<ValueWithError>& shutter) {
  const auto find = [&](std::string_view key) {
    return std::find_if(nuisances.begin(), nuisances.end(),
                        [&](const CameraNuisance& nuisance) { return nuisance.key == key; });
  };
  const std::string key = known.key_of(&Camera::shutter);
  const auto rows = find(key);
  if (rows == nuisances.end() || find(known.key_of(&Camera::time_offset)) == nuisances.end()) return 0;
  const ValueWithError taken =
      shutter ? *shutter : ValueWithError{get_number(setup, key, known), rows->deviation()};
  return std::hypot(taken.value, taken.error) / 2;
}

}  // namespace

std::vector<Knob> camera_knobs(const Setup& setup, const Measurement& measurement, KnownEffects known,
                               const std::optional<ValueWithError>& shutter) {
  std::vector<Knob> knobs;
  const std::vector<CameraNuisance> nuisances = camera_nuisances(measurement, known);
  for (const CameraNuisance& nuisance : nuisances) {
    if (nuisance.each_run || !find_camera_parameter(known, nuisance.key)) continue;
    knobs.push_back(exact_knob(nuisance.key, get_number(setup, nuisance.key, known), nuisance.deviation()));
  }
  if (const double late = late_by_rows(setup, nuisances, known, shutter); late > 0) {
    const std::string key = known.key_of(&Camera::time_offset);
    knobs.push_back(exact_knob(key, get_number(setup, key, known), late));
  }
  return knobs;
}

namespace {

/// Returns the sum of the weights, each times exp(sign (t - middle) / memory).
double weighed(const FeaturePlan::Reading& reading, double middle, double memory, double sign) {
  double sum = 0;
  for (std::size_t i = 0; i < reading.weight.size(); ++i)
    sum += reading.weight[i] * std::exp(sign * (reading.time[i] - middle) / memory);
  return sum;
}

double own_variance(const FeaturePlan::Reading& reading, double memory) {
  double sum = 0;
  for (std::size_t i = 0; i < reading.weight.size(); ++i)
    for (std::size_t k = 0; k < reading.weight.size(); ++k)
      sum += reading.weight[i] * reading.weight[k] *
             std::exp(-std::abs(reading.time[i] - reading.time[k]) / memory);
  return sum;
}

}  // namespace

Eigen::MatrixXd wander_covariance(const FeaturePlan& plan, const Wander& wander) {
  const Eigen::Index count = std::ssize(plan.features);
  // Frames of one bin lie before all of a later one, where exp(-(t' - t) / memory) is a product.
  Eigen::ArrayXd leaving(count), arriving(count);
  for (Eigen::Index f = 0; f < count; ++f) {
    const FeaturePlan::Reading& reading = plan.readings[static_cast<std::size_t>(f)];
    const double middle = plan.features[static_cast<std::size_t>(f)].time;
    leaving[f] = weighed(reading, middle, wander.time, 1);
    arriving[f] = weighed(reading, middle, wander.time, -1);
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index a = 0; a < count; ++a) {
    const Feature& first = plan.features[static_cast<std::size_t>(a)];
    covariance(a, a) = own_variance(plan.readings[static_cast<std::size_t>(a)], wander.time);
    for (Eigen::Index b = a + 1; b < count; ++b) {
      const Feature& later = plan.features[static_cast<std::size_t>(b)];
      if (later.observable != first.observable) break;
      covariance(a, b) = covariance(b, a) =
          leaving[a] * arriving[b] * std::exp(-(later.time - first.time) / wander.time);
    }
  }
  return wander.deviation * wander.deviation * covariance;
}

void add_wander(const Wander& wander, std::vector<MeasuredFeatures>& measured) {
  if (!(wander.deviation > 0) || !(wander.time > 0)) return;
  for (MeasuredFeatures& run : measured) {
    const Eigen::MatrixXd root = wander_covariance(run.plan, wander).llt().matrixL();
    const Eigen::Index before = run.own.cols();
    run.own.conservativeResize(run.values.size(), before + root.cols());
    run.own.rightCols(root.cols()) = root;
  }
}

}  // namespace shakedown
