// SPDX-License-Identifier: MIT
#include "damper_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "nuisance.hpp"
#include "parameter_knobs.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

double greatest(const std::vector<double>& list) {
  double most = 0;
  for (const double one : list) most = std::max(most, std::abs(one));
  return most;
}

constexpr double apart = 2;        // standard deviations, at least: a straight line about the value
constexpr double farther = 4;      // standard deviations, at most: half the noise of a column
constexpr double straight = 0.02;  // of the value: so far a line holds, whatever the error is
constexpr double beyond = 3;       // greatest shifts: a column's noise counts by a third of itself

double step_of(const DamperError& error, double value) {
  const double deviation = greatest(error.deviation);
  return std::max(std::clamp(straight * std::abs(value), apart * deviation, farther * deviation),
                  beyond * greatest(error.shift));
}

bool matters(const DamperError& error) {
  return std::any_of(error.deviation.begin(), error.deviation.end(), [](double one) { return one > 0; });
}

/// Returns for each run, m, where it was let go less the mean of its repeats. A straight line holds up to a
/// hundredth of the release, whose square is a tenth of a thousandth; repeats that lie farther apart get no
/// shift.
std::vector<double> shifts_of(const Measurement& measurement, const std::vector<double>& deviation) {
  constexpr double alike = 0.01;
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t r = 0; r < measurement.runs.size(); ++r) {
    if (!(deviation[r] > 0)) continue;
    Setup of_run = measurement.runs[r].setup;
    of_run.run.duration = of_run.release.displacement = 1;
    groups[digest(of_run)].push_back(r);
  }
  std::vector<double> shift(measurement.runs.size(), 0);
  for (const auto& [key, members] : groups) {
    double mean = 0, farthest = 0;
    for (const std::size_t r : members)
      mean += measurement.runs[r].setup.release.displacement / static_cast<double>(members.size());
    for (const std::size_t r : members) {
      shift[r] = measurement.runs[r].setup.release.displacement - mean;
      farthest = std::max(farthest, std::abs(shift[r]));
    }
    if (farthest > alike * std::abs(mean))
      for (const std::size_t r : members) shift[r] = 0;
  }
  return shift;
}

void take_shared_values(const std::vector<DamperError>& errors, std::vector<MeasuredFeatures>& measured,
                        KnownEffects known) {
  for (const DamperError& error : errors)
    for (std::size_t r = 0; r < error.shift.size(); ++r) {
      Setup& setup = measured[r].setup;
      if (error.shift[r] != 0)
        set_number(setup, error.key, get_number(setup, error.key) - error.shift[r], known);
    }
}

std::vector<Eigen::VectorXd> means_of(const std::vector<MeasuredFeatures>& measured, int count, int first_run,
                                      const Workshop& workshop) {
  std::vector<Eigen::VectorXd> means;
  for (const Emulator& e : emulate(measured, {}, count, first_run, workshop))
    means.push_back(e.coefficients.row(0).transpose());
  return means;
}

}  // namespace

std::vector<DamperError> damper_errors(const Measurement& measurement) {
  const std::size_t runs = measurement.runs.size();
  DamperError release{"release.displacement", std::vector<double>(runs, 0), true};
  for (std::size_t r = 0; r < runs; ++r)
    if (measurement.runs[r].setup.grains.count > 0)
      release.deviation[r] = measurement.runs[r].recorded.release_error;
  release.shift = shifts_of(measurement, release.deviation);
  std::vector<DamperError> list{release};
  for (const WeighedNuisance& weighed : weighed_nuisances(measurement)) {
    DamperError error{weighed.key, std::vector<double>(runs, 0), weighed.of_one_run};
    for (const std::size_t r : weighed.runs)
      if (measurement.runs[r].setup.grains.count > 0) error.deviation[r] = weighed.deviation;
    list.push_back(std::move(error));
  }
  std::erase_if(list, [](const DamperError& error) { return !matters(error); });
  return list;
}

std::vector<FeatureColumns> columns_of(const std::vector<DamperError>& errors,
                                       const std::vector<MeasuredFeatures>& of_runs, int count, int first_run,
                                       const Workshop& workshop) {
  std::vector<FeatureColumns> list;
  if (errors.empty()) return list;
  std::vector<MeasuredFeatures> measured = of_runs;
  take_shared_values(errors, measured, workshop.known);
  const std::vector<Eigen::VectorXd> without = means_of(measured, count, first_run, workshop);
  for (const DamperError& error : errors) {
    // One step for all runs, so that repeats go on sharing their simulations.
    const double step = step_of(error, get_number(measured.front().setup, error.key));
    std::vector<MeasuredFeatures> changed = measured;
    for (std::size_t r = 0; r < changed.size(); ++r) {
      if (!(error.deviation[r] > 0)) continue;
      Setup& setup = changed[r].setup;
      set_number(setup, error.key, get_number(setup, error.key) + step, workshop.known);
    }
    FeatureColumns columns = means_of(changed, count, first_run, workshop);
    for (std::size_t r = 0; r < columns.size(); ++r) {
      columns[r] -= without[r];
      if (error.deviation[r] > 0)
        columns[r] /= step;
      else
        columns[r].setZero();
    }
    list.push_back(std::move(columns));
  }
  return list;
}

void add_columns(const std::vector<DamperError>& errors, const std::vector<FeatureColumns>& columns,
                 KnownEffects known, std::vector<MeasuredFeatures>& measured) {
  take_shared_values(errors, measured, known);
  for (std::size_t e = 0; e < columns.size(); ++e)
    for (std::size_t r = 0; r < measured.size(); ++r) {
      MeasuredFeatures& run = measured[r];
      if (!errors[e].shift.empty()) run.values -= errors[e].shift[r] * columns[e][r];
      if (!errors[e].each_run) {
        run.by_camera[errors[e].key] = columns[e][r];
      } else if (errors[e].deviation[r] > 0) {
        run.own.conservativeResize(run.values.size(), run.own.cols() + 1);
        run.own.rightCols(1) = errors[e].deviation[r] * columns[e][r];
      }
    }
}

std::vector<Knob> knobs_of(const std::vector<DamperError>& errors, const Setup& setup) {
  std::vector<Knob> knobs;
  for (const DamperError& error : errors) {
    if (error.each_run) continue;
    knobs.push_back(exact_knob(error.key, get_number(setup, error.key),
                               *std::max_element(error.deviation.begin(), error.deviation.end())));
  }
  return knobs;
}

}  // namespace shakedown
