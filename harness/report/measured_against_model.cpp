// SPDX-License-Identifier: MIT
#include "measured_against_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "camera.hpp"
#include "ensemble.hpp"
#include "interpolation.hpp"
#include "physics.hpp"
#include "report_parts.hpp"
#include "running_statistic.hpp"

namespace shakedown {

namespace {

/// Mean and spread of one number of an ensemble at each moment.
struct CurveStatistics {
  std::vector<RunningStatistic> at;
  explicit CurveStatistics(std::size_t size) : at(size) {}
  EnsembleCurve curve() const {
    EnsembleCurve curve;
    for (const RunningStatistic& running : at) {
      const Statistic found = running.statistic();
      curve.mean.push_back(found.mean);
      curve.sd.push_back(found.n == 1 ? 0 : found.sd);
    }
    return curve;
  }
};

/// Simulates one ensemble at these times, s. `begin`: s, time at which the model is let go.
ModelMotion motion_of(Setup setup, const std::vector<double>& time, double begin, const Engine& engine,
                      const CurveOptions& options) {
  setup.run.duration = std::max(0.1, time.back() - begin + 0.1);
  setup.run.sample_rate = 250;
  const Camera camera = physics_of(setup).camera;
  CurveStatistics box(time.size()), centre(time.size()), energy(time.size());
  std::vector<CurveStatistics> loss(contact_classes, CurveStatistics(time.size()));
  ModelMotion motion;
  EnsembleOptions many;
  many.runs = options.runs;
  many.first_run = options.first_run;
  many.execution = options.execution;
  many.each = [&](int, const Trajectory& trajectory, const Observables&) {
    const Recording seen = recorded_by(camera, trajectory);
    for (std::size_t i = 0; i < time.size(); ++i) {
      const double at = std::max(0.0, time[i] - begin);
      box.at[i].add(interpolated(seen.time, seen.x_box, at));
      if (!seen.x_com.empty()) centre.at[i].add(interpolated(seen.time, seen.x_com, at));
      energy.at[i].add(interpolated(trajectory.time, trajectory.total_energy, at));
      for (std::size_t c = 0; c < loss.size(); ++c)
        loss[c].at[i].add(interpolated(trajectory.time, trajectory.loss[c], at));
    }
    motion.health = worse_of(std::move(motion.health), trajectory.health);
    for (const std::int64_t n : trajectory.collisions) motion.collisions += std::max<std::int64_t>(n, 0);
    ++motion.runs;
  };
  run_ensemble(engine, setup, many);
  if (options.execution.stopped()) throw Interrupted("the curves of the report were not finished");
  motion.box = box.curve();
  motion.centre = centre.curve();
  motion.energy = energy.curve();
  for (std::size_t c = 0; c < loss.size(); ++c) motion.loss[c] = loss[c].curve();
  return motion;
}

std::vector<double> residual(const std::vector<double>& measured, const EnsembleCurve& model, double noise,
                             int runs) {
  std::vector<double> result(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i)
    result[i] = (measured[i] - model.mean[i]) /
                std::sqrt(model.sd[i] * model.sd[i] * (1 + 1.0 / runs) + noise * noise);
  return result;
}

/// The frames of a run that are drawn: those next to moments of equal distance, at their own times, for a box
/// that is fast goes far in half a frame. Where a frame is missing the moment stays, so that the model is
/// drawn there.
struct Moments {
  std::vector<double> time;                       ///< s
  std::vector<std::optional<std::size_t>> frame;  ///< of the run
};
Moments moments_of(const MeasuredRun& run, double rate, double end, double interval) {
  Moments moments;
  for (std::int64_t k = 0; static_cast<double>(k) / rate <= end; ++k) {
    double time = static_cast<double>(k) / rate;
    std::optional<std::size_t> frame;
    auto i =
        static_cast<std::size_t>(std::lower_bound(run.time.begin(), run.time.end(), time) - run.time.begin());
    if (i == run.time.size() || (i > 0 && time - run.time[i - 1] < run.time[i] - time)) --i;
    if (std::abs(run.time[i] - time) <= interval) frame = i, time = run.time[i];
    if (!moments.time.empty() && time <= moments.time.back()) continue;
    moments.time.push_back(time);
    moments.frame.push_back(frame);
  }
  return moments;
}

std::vector<double> measured_at(const Moments& moments, const std::vector<double>& values) {
  std::vector<double> result(moments.time.size(), std::nan(""));
  for (std::size_t k = 0; k < result.size() && !values.empty(); ++k)
    if (moments.frame[k]) result[k] = values[*moments.frame[k]];
  return result;
}

}  // namespace

std::vector<MeasuredAgainstModel> measured_against_model(const Measurement& measurement, const Setup* given,
                                                         const Setup& final_setup, const Engine& engine,
                                                         const CurveOptions& options) {
  std::vector<MeasuredAgainstModel> all;
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    const MeasuredRun& run = measurement.runs[r].recorded;
    const RunAudit& found = measurement.runs[r].audit;
    if (run.time.empty()) continue;
    const Setup last = options.final_of_run.empty() ? setup_of_run(final_setup, run, options.known)
                                                    : options.final_of_run[r];
    const Setup first = given != nullptr ? setup_of_run(*given, run, options.known) : last;
    const double begin = options.from_first_frame ? run.time.front() : 0;
    MeasuredAgainstModel one;
    one.run = run.name;
    one.given = first;
    one.amended = last;
    one.box_noise = found.box.standard_deviation;
    one.centre_noise = found.com.standard_deviation;
    const double end = std::min(run.time.back(), 60.0);
    const Moments moments = moments_of(run, options.rate, end, found.frame_interval);
    one.time = moments.time;
    one.box = measured_at(moments, found.x_box);
    one.centre = measured_at(moments, found.x_com);
    one.final_model = motion_of(last, one.time, begin, engine, options);
    if (given != nullptr) {
      one.as_given = motion_of(first, one.time, begin, engine, options);
      one.given_box_residual = residual(one.box, one.as_given.box, one.box_noise, one.as_given.runs);
      one.given_centre_residual =
          residual(one.centre, one.as_given.centre, one.centre_noise, one.as_given.runs);
    }
    one.box_residual = residual(one.box, one.final_model.box, one.box_noise, one.final_model.runs);
    one.centre_residual =
        residual(one.centre, one.final_model.centre, one.centre_noise, one.final_model.runs);
    all.push_back(std::move(one));
    if (options.progress)
      options.progress(static_cast<double>(r + 1) / static_cast<double>(measurement.runs.size()));
  }
  return all;
}

}  // namespace shakedown
