// SPDX-License-Identifier: MIT
// Many runs of one setup that differ by their random numbers only.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine.hpp"
#include "execution.hpp"
#include "observables.hpp"
#include "statistic.hpp"

namespace shakedown {

struct EnsembleOptions {
  int runs = 1;
  int first_run = 0;  ///< number of the first run; the number addresses a run's random numbers
  Execution execution{.threads = 1};
  bool keep_samples = false;    ///< keep the sampled motion of every run in memory, not only its totals
  bool log_collisions = false;  ///< each run's Trajectory::collision_log; kept in memory as its samples are
  /// Called with the fraction of the whole that is done, one call at a time, from any thread; may be empty.
  std::function<void(double fraction)> progress;
  /// Receives every finished run with its samples, one at a time in ascending order of run number, from any
  /// thread; may be empty.
  std::function<void(int run, const Trajectory& trajectory, const Observables& observables)> each;
};

struct RunResult {
  int run = 0;
  Observables observables;
  Trajectory trajectory;  ///< without samples unless they were asked for
};

struct Ensemble {
  std::string engine;
  int requested = 0;
  /// In ascending order of run number. Of an interrupted ensemble the runs that finished; a single run is
  /// kept as far as it came.
  std::vector<RunResult> runs;
  bool interrupted = false;
  double wall_seconds = 0;

  /// Returns mean and spread of a number over the runs.
  Statistic over_runs(const std::function<double(const RunResult&)>& number) const;
};

/// Runs the setup as often as asked. Throws what the engine throws; of several failing runs, the error of the
/// lowest number.
Ensemble run_ensemble(const Engine& engine, const Setup& setup, const EnsembleOptions& options);

}  // namespace shakedown
