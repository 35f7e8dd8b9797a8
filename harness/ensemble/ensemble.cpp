// SPDX-License-Identifier: MIT
#include "ensemble.hpp"

#include <chrono>
#include <memory>
#include <mutex>

#include "in_order.hpp"

namespace shakedown {

namespace {

/// Adds up the progress of runs that go on at the same time.
class Progress {
 public:
  Progress(const EnsembleOptions& options, double duration)
      : report_(options.progress),
        whole_(options.runs * duration),
        done_(static_cast<std::size_t>(options.runs), 0.0) {}

  std::function<void(double)> of_run(int index) {
    if (!report_) return {};
    return [this, index](double time) {
      const std::lock_guard lock(mutex_);
      sum_ += time - done_[static_cast<std::size_t>(index)];
      done_[static_cast<std::size_t>(index)] = time;
      report_(sum_ / whole_);
    };
  }

 private:
  const std::function<void(double)>& report_;
  const double whole_;
  double sum_ = 0;
  std::vector<double> done_;
  std::mutex mutex_;
};

void drop_samples(Trajectory& trajectory) {
  for (auto* samples :
       {&trajectory.time, &trajectory.x_box, &trajectory.v_box, &trajectory.x_com, &trajectory.total_energy,
        &trajectory.loss[0], &trajectory.loss[1], &trajectory.loss[2]})
    *samples = {};
  trajectory.collision_log.reset();
}

}  // namespace

Statistic Ensemble::over_runs(const std::function<double(const RunResult&)>& number) const {
  std::vector<double> values;
  values.reserve(runs.size());
  for (const RunResult& run : runs) values.push_back(number(run));
  return statistic_of(values);
}

Ensemble run_ensemble(const Engine& engine, const Setup& setup, const EnsembleOptions& options) {
  EXPECT(options.runs >= 1 && options.first_run >= 0);
  const auto start = std::chrono::steady_clock::now();
  const auto stopped = [&] { return options.execution.stopped(); };
  Ensemble ensemble{std::string(engine.name()), options.runs, {}, false, 0};
  ensemble.runs.reserve(static_cast<std::size_t>(options.runs));
  Progress progress(options, setup.run.duration);

  const auto work = [&](int index) -> std::function<void()> {
    if (stopped()) return {};
    auto result = std::make_shared<RunResult>();
    result->run = options.first_run + index;
    try {
      result->trajectory = engine.run(
          setup, {result->run, progress.of_run(index), options.execution.stop, options.log_collisions});
    } catch (const Interrupted&) {
      return {};
    }
    if (result->trajectory.interrupted && options.runs > 1) return {};
    result->observables = observe(result->trajectory, setup);
    return [&, result] {
      if (options.each) options.each(result->run, result->trajectory, result->observables);
      if (!options.keep_samples) drop_samples(result->trajectory);
      ensemble.runs.push_back(std::move(*result));
    };
  };
  work_in_parallel_deliver_in_order(options.runs, options.execution.threads, work);

  ensemble.interrupted =
      static_cast<int>(ensemble.runs.size()) < options.runs || ensemble.runs[0].trajectory.interrupted;
  ensemble.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return ensemble;
}

}  // namespace shakedown
