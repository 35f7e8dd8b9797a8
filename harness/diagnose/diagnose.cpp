// SPDX-License-Identifier: MIT
#include "diagnosis.hpp"

#include <algorithm>
#include <chrono>

#include "course.hpp"
#include "experiment.hpp"
#include "known_setup.hpp"
#include "release_known.hpp"
#include "rules.hpp"
#include "setup_keys.hpp"
#include "state.hpp"
#include "swing.hpp"

namespace shakedown {

namespace {

/// Returns the measurement in which what the user wants fixed is known exactly, as the setup says it.
Measurement with_fixed(Measurement measurement, const Setup& user, const DiagnoseOptions& options) {
  for (const std::string& key : options.fixed) {
    std::erase_if(measurement.known, [&](const KnownValue& one) { return one.key == key; });
    measurement.known.push_back({key, get_number(user, key), 0, {}});
  }
  return measurement;
}

}  // namespace

void note_failures(const Refit& fit, Diagnosis& diagnosis) {
  constexpr std::size_t most_cells = 12;
  diagnosis.where.clear();
  for (const FailureCell& cell : fit.cells)
    if (cell.p_value < rules::doubtful && diagnosis.where.size() < most_cells)
      diagnosis.where.push_back(cell);
}

Diagnosis diagnose(const Setup& setup, const Measurement& measurement, const Engine& engine,
                   const DiagnoseOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  if (const std::int64_t least = least_budget(measurement);
      options.budget > 0 && options.budget < least && !is_empty(setup, measurement))
    throw InputError({{{"--budget", 0, 0},
                       "",
                       "allows fewer simulations than one fit of the model as given and one with free "
                       "parameters need",
                       "allow " + std::to_string(least) + " or more"}});
  const Setup user = with_known(setup, measurement.known, options.known);
  const Measurement released = with_measured_release(with_fixed(measurement, user, options), options.known);
  constexpr double periods = 1.5;  // the first swing and its way back
  const bool empty = is_empty(user, released);
  const Measurement started = empty ? released : from_first_turns(released, engine, periods);
  Diagnosis result = Course(user, released, started, engine, options).run();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace shakedown
