// SPDX-License-Identifier: MIT
#include "damper_errors.hpp"

#include <algorithm>

#include "nuisance.hpp"
#include "parameter_knobs.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

constexpr double apart = 2;  // standard deviations: a straight line about the value

bool matters(const DamperError& error) {
  return std::any_of(error.deviation.begin(), error.deviation.end(), [](double one) { return one > 0; });
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
    if (const Setup& setup = measurement.runs[r].setup;
        setup.grains.count > 0 && setup.release.initial_grains.empty())
      release.deviation[r] = measurement.runs[r].recorded.release_error;
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
                                       const std::vector<MeasuredFeatures>& measured, int count,
                                       int first_run, const Workshop& workshop) {
  std::vector<FeatureColumns> list;
  if (errors.empty()) return list;
  const std::vector<Eigen::VectorXd> without = means_of(measured, count, first_run, workshop);
  for (const DamperError& error : errors) {
    std::vector<MeasuredFeatures> changed = measured;
    for (std::size_t r = 0; r < changed.size(); ++r) {
      Setup& setup = changed[r].setup;
      set_number(setup, error.key, get_number(setup, error.key) + apart * error.deviation[r], workshop.known);
    }
    FeatureColumns columns = means_of(changed, count, first_run, workshop);
    for (std::size_t r = 0; r < columns.size(); ++r) {
      columns[r] -= without[r];
      if (error.deviation[r] > 0)
        columns[r] /= apart * error.deviation[r];
      else
        columns[r].setZero();
    }
    list.push_back(std::move(columns));
  }
  return list;
}

void add_columns(const std::vector<DamperError>& errors, const std::vector<FeatureColumns>& columns,
                 std::vector<MeasuredFeatures>& measured) {
  for (std::size_t e = 0; e < columns.size(); ++e)
    for (std::size_t r = 0; r < measured.size(); ++r) {
      MeasuredFeatures& run = measured[r];
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
