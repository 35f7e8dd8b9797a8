// SPDX-License-Identifier: MIT
// One table holds the numbers that a sweep keeps of each run; columns, averages and digests come from it.
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

/// Returns the numbers in the order of the columns. New ones go to the end, so that files made before lack
/// the last columns only.
std::span<const RunNumber> run_numbers();

/// Returns all of them for a run, NaN where it has no such number.
std::vector<double> numbers_of_run(const Setup& setup, const Trajectory& trajectory);

}  // namespace shakedown
