// SPDX-License-Identifier: MIT
#include "damper_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ensemble.hpp"
#include "friction_oscillator.hpp"
#include "least_squares.hpp"
#include "theory.hpp"

namespace shakedown {

namespace {

/// Returns the number of samples before the first small peak; all when there is none.
std::size_t end_of_decay(const Trajectory& trajectory, const Observables& seen) {
  const double end = std::isnan(seen.first_small_peak) ? trajectory.time.back() : seen.first_small_peak;
  return static_cast<std::size_t>(std::lower_bound(trajectory.time.begin(), trajectory.time.end(), end) -
                                  trajectory.time.begin());
}

void read_friction(const Setup& setup, const Trajectory& trajectory, RunReading& reading) {
  if (reading.seen.peaks.size() < 3) return;
  const Theory theory = theory_of(setup);
  reading.friction = effective_friction(theory.stiffness, setup.release.displacement,
                                        std::abs(reading.seen.peaks[2].position));
  const FrictionOscillator curve{theory.stiffness, theory.total_mass, std::max(0.0, reading.friction),
                                 setup.release.displacement};
  double left = 0, whole = 0;
  for (std::size_t i = 0; i < end_of_decay(trajectory, reading.seen); ++i) {
    const double off = trajectory.x_box[i] - curve.position_at(trajectory.time[i]);
    left += off * off;
    whole += trajectory.x_box[i] * trajectory.x_box[i];
  }
  reading.friction_curve_r2 = 1 - left / whole;
}

void read_energy(const Trajectory& trajectory, RunReading& reading) {
  const std::size_t end = end_of_decay(trajectory, reading.seen);
  if (end < 100) return;
  const auto count = static_cast<Eigen::Index>(end);
  Eigen::MatrixXd columns(count, 2);
  Eigen::VectorXd root(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    columns.row(i) << 1, trajectory.time[static_cast<std::size_t>(i)];
    root[i] = std::sqrt(trajectory.total_energy[static_cast<std::size_t>(i)]);
  }
  const LeastSquares line = least_squares(columns, root);
  reading.energy_line_r2 = 1 - line.rms * line.rms / ((root.array() - root.mean()).square().mean());
  std::vector<Peak> points;  // an exponential through the same, every 20 ms
  for (std::size_t i = 0; i < end; i += 10)
    points.push_back({trajectory.time[i], root[static_cast<Eigen::Index>(i)]});
  const Decay decay = decay_through(points);
  reading.energy_line_ratio = decay.linear.rms / decay.exponential.rms;
  // Over 20 ms, so that single impacts do not count as steps.
  const std::size_t hop = 10;
  const double mean_rate = -line.coefficients[1];
  std::size_t flat = 0, seen = 0;
  for (std::size_t i = 0; i + hop < end; i += hop, ++seen) {
    const double rate = (root[static_cast<Eigen::Index>(i)] - root[static_cast<Eigen::Index>(i + hop)]) /
                        (trajectory.time[i + hop] - trajectory.time[i]);
    flat += rate < mean_rate / 5;
  }
  reading.energy_flat = static_cast<double>(flat) / static_cast<double>(seen);
}

/// Reads the first stroke: the box's top speed, and how fast the grains fly from 0.3 to 0.7 of the crossing
/// time later, before they land.
void read_leaving(const Setup& setup, const Trajectory& trajectory, RunReading& reading) {
  const Theory theory = theory_of(setup);
  const double quarter = 0.25 / theory.loaded_frequency;
  std::size_t top = 0;
  for (std::size_t i = 0; i < trajectory.time.size() && trajectory.time[i] < 1.5 * quarter; ++i)
    if (std::abs(trajectory.v_box[i]) > std::abs(trajectory.v_box[top])) top = i;
  const auto sample = [&](double time) {
    return static_cast<std::size_t>(std::lround(time * setup.run.sample_rate));
  };
  const std::size_t from = top + sample(0.3 * theory.time_through_box),
                    to = top + sample(0.7 * theory.time_through_box);
  if (to <= from || to >= trajectory.time.size() || trajectory.v_box[top] == 0) return;
  const double speed =
      (trajectory.x_com[to] - trajectory.x_com[from]) / (trajectory.time[to] - trajectory.time[from]);
  reading.leaving_speed_ratio = speed / trajectory.v_box[top];
  reading.leaving_phase = std::abs(trajectory.x_box[top]) / setup.release.displacement;
}

double swing_after(const Trajectory& trajectory, double from) {
  double swing = trajectory.time.back() > from ? 0 : absent;
  for (std::size_t i = 0; i < trajectory.time.size(); ++i)
    if (trajectory.time[i] >= from) swing = std::max(swing, std::abs(trajectory.x_box[i]));
  return swing;
}

RunReading reading_of(const Setup& setup, const Trajectory& trajectory, const Observables& seen) {
  RunReading reading;
  reading.seen = seen;
  read_friction(setup, trajectory, reading);
  read_energy(trajectory, reading);
  read_leaving(setup, trajectory, reading);
  reading.swing_after_1s = swing_after(trajectory, 1);
  reading.swing_after_20s = swing_after(trajectory, 20);
  return reading;
}

/// The mean over runs at each time, and the sum of squares about it.
struct Average {
  std::vector<double> mean, squares;
  void add(const std::vector<double>& values, int number) {
    mean.resize(values.size(), 0), squares.resize(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double off = values[i] - mean[i];
      mean[i] += off / number;
      squares[i] += off * (values[i] - mean[i]);
    }
  }
  double rms_of_one(int runs) const {
    double sum = 0;
    for (const double square : squares) sum += square;
    return runs < 2 ? std::nan("") : std::sqrt(sum / static_cast<double>(squares.size()) / (runs - 1));
  }
};

}  // namespace

Statistic DamperRuns::over(const std::function<double(const RunReading&)>& what) const {
  std::vector<double> values;
  for (const RunReading& run : runs) values.push_back(what(run));
  return statistic_of(values);
}

Statistic DamperRuns::over(double RunReading::*what) const {
  return over([what](const RunReading& run) { return run.*what; });
}

std::string name_of(const DamperRuns& runs) {
  return fmt::format("L = {:g} mm, {}", 1e3 * runs.setup.box.length, runs.engine);
}

DamperRuns damper_runs(const Engine& engine, const Setup& setup, const RunsWanted& wanted) {
  DamperRuns result{std::string(engine.name()), setup, {}, {}, {}, {}, {}, 0, 0};
  Average box, centre, root_energy;
  EnsembleOptions options;
  options.runs = wanted.runs;
  options.execution = wanted.execution;
  options.each = [&](int, const Trajectory& trajectory, const Observables& seen) {
    if (result.runs.empty()) result.first = trajectory;
    result.runs.push_back(reading_of(setup, trajectory, seen));
    const int number = static_cast<int>(result.runs.size());
    box.add(trajectory.x_box, number);
    centre.add(trajectory.x_com, number);
    std::vector<double> root(trajectory.total_energy);
    for (double& energy : root) energy = std::sqrt(std::max(0.0, energy));
    root_energy.add(root, number);
  };
  if (run_ensemble(engine, setup, options).interrupted) throw Interrupted("stopped while the damper ran");
  result.mean_x_box = box.mean, result.mean_x_com = centre.mean, result.mean_root_energy = root_energy.mean;
  result.rms_of_one_run_box = box.rms_of_one(wanted.runs);
  result.rms_of_one_run_centre = centre.rms_of_one(wanted.runs);
  return result;
}

}  // namespace shakedown
