// SPDX-License-Identifier: MIT
// Many setups, many runs of each, on every core of every machine that a scheduler gives; results go into a
// file as they come.
#pragma once
#include <functional>
#include <string>

#include "execution.hpp"
#include "result_file.hpp"
#include "share.hpp"
#include "sweep_plan.hpp"

namespace shakedown {

/// The cost of a sweep, as up to three runs of this share tell it; they are kept.
struct SweepCost {
  std::size_t points = 0;
  std::size_t jobs = 0;      ///< points times runs, of all shares
  std::size_t here = 0;      ///< of them this process' share
  std::size_t done = 0;      ///< of the share, in the file already when this process came
  double seconds_a_run = 0;  ///< on one thread
  double seconds = 0;        ///< what is left, on the threads given
};

struct SweepOptions {
  Execution execution{};  ///< stopped early, what is finished is in the file
  JobShare share{};
  /// Told once before the bulk begins; returns whether to go on. May be empty.
  std::function<bool(const SweepCost& cost)> announce{};
  /// Fraction done of what was left; one call at a time, from any thread. May be empty.
  std::function<void(double fraction)> progress{};
};

struct SweepOutcome {
  SweepCost cost;
  std::size_t added = 0,
              failed = 0;  ///< runs added by this process; those of them in which the engine gave up
  std::string first_failure;
  bool interrupted = false;  ///< something of the share is left to do
};

/// Runs what the file does not hold yet of the share. A run in which the engine breaks its promise is kept as
/// a failure.
SweepOutcome run_sweep(const Engine& engine, const SweepPlan& plan, ResultFile& file,
                       const SweepOptions& options);

}  // namespace shakedown
