// SPDX-License-Identifier: MIT
// The numbers that a sweep keeps of each run: one table from which columns, averages and digests come.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "observables.hpp"
#include "setup.hpp"
#include "steady_forcing.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// All that is known of one run.
struct SeenRun {
  const Trajectory& trajectory;
  const Observables& observables;
  const SteadyState& steady;  ///< NaN without forcing
};

struct RunNumber {
  std::string_view name;  ///< column, unit included: "slope_mm_per_s"
  double (*of)(const SeenRun& run);
};

/// In the order of the columns. New ones go to the end: files made before then lack the last columns.
std::span<const RunNumber> run_numbers();

/// All of them, NaN where a run has no such number.
std::vector<double> numbers_of_run(const Setup& setup, const Trajectory& trajectory);

}  // namespace shakedown
