// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <mutex>

#include "in_order.hpp"
#include "run_numbers.hpp"

namespace shakedown {

namespace {

struct Job {
  const SweepPoint* point;
  int run;
};

/// Calls work(0) ... work(count - 1) on some threads, in no particular order: a result is kept as soon as it
/// is there, so nobody waits for his turn. When one throws, no more are begun, and the first exception is
/// thrown on.
void work_in_any_order(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto serve = [&] {
    for (std::size_t job = next++; job < count; job = next++) {
      try {
        work(job);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  constexpr std::size_t most_threads = 1024;
  serve_on_threads(std::min<int>(threads, static_cast<int>(std::min(count, most_threads))), serve);
  if (failure) std::rethrow_exception(failure);
}

class Sweeper {
 public:
  Sweeper(const Engine& engine, const SweepPlan& plan, ResultFile& file, const SweepOptions& options)
      : engine_(engine), plan_(plan), file_(file), options_(options) {
    const std::set<std::pair<std::string, int>> finished = file.finished();
    SweepCost& cost = outcome_.cost;
    cost.points = plan.points.size();
    // Run by run over all points: whatever the moment of an interruption, the whole range is covered evenly.
    for (int run = 0; run < plan.runs; ++run)
      for (const SweepPoint& point : plan.points) {
        if (!options.share.has(cost.jobs++)) continue;
        ++cost.here;
        if (finished.contains({point.digest, run}))
          ++cost.done;
        else
          jobs_.push_back({&point, run});
      }
  }

  SweepOutcome run() {
    pilot();
    SweepCost& cost = outcome_.cost;
    const std::size_t left = jobs_.size();
    cost.seconds =
        cost.seconds_a_run * static_cast<double>(left) / threads_or_all(options_.execution.threads);
    const bool go_on = !options_.announce || options_.announce(cost);
    whole_ = left;
    if (go_on)
      work_in_any_order(left, threads_or_all(options_.execution.threads),
                        [&](std::size_t job) { do_one(jobs_[job]); });
    outcome_.interrupted = cost.done + outcome_.added < cost.here;
    return outcome_;
  }

 private:
  bool stopped() const { return options_.execution.stopped(); }

  /// Runs first, middle and last point of what is left: their time tells the cost.
  void pilot() {
    if (jobs_.empty()) return;
    std::set<std::size_t> chosen{0, std::min(jobs_.size(), plan_.points.size()) / 2,
                                 std::min(jobs_.size(), plan_.points.size()) - 1};
    std::vector<Job> pilots;
    for (auto place = chosen.rbegin(); place != chosen.rend(); ++place) {
      pilots.push_back(jobs_[*place]);
      jobs_.erase(jobs_.begin() + static_cast<std::ptrdiff_t>(*place));
    }
    work_in_any_order(pilots.size(), threads_or_all(options_.execution.threads),
                      [&](std::size_t job) { do_one(pilots[job]); });
    outcome_.cost.seconds_a_run = seconds_ / static_cast<double>(std::max<std::size_t>(1, outcome_.added));
  }

  void do_one(const Job& job) {
    if (stopped()) return;
    const auto start = std::chrono::steady_clock::now();
    ResultRow row{job.point->digest, job.run, {}, "", 0, std::vector<double>(run_numbers().size(), absent)};
    for (std::size_t a = 0; a < plan_.axes.size(); ++a)
      row.varied.push_back(plan_.axes[a].shown(job.point->values[a]));
    try {
      const Trajectory trajectory = engine_.run(job.point->setup, {job.run, {}, options_.execution.stop});
      if (trajectory.interrupted) return;
      row.numbers = numbers_of_run(job.point->setup, trajectory);
    } catch (const PhysicsError& error) {
      row.failure = error.what();
    } catch (const Interrupted&) {
      return;
    }
    row.engine_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    file_.add(row);
    note(row);
  }

  void note(const ResultRow& row) {
    const std::lock_guard lock(mutex_);
    ++outcome_.added;
    seconds_ += row.engine_seconds;
    if (!row.failure.empty() && outcome_.failed++ == 0) outcome_.first_failure = row.failure;
    if (whole_ > 0 && options_.progress)
      options_.progress(static_cast<double>(++finished_) / static_cast<double>(whole_));
  }

  const Engine& engine_;
  const SweepPlan& plan_;
  ResultFile& file_;
  const SweepOptions& options_;
  std::vector<Job> jobs_;
  SweepOutcome outcome_;
  std::mutex mutex_;
  std::size_t whole_ = 0, finished_ = 0;
  double seconds_ = 0;
};

}  // namespace

SweepOutcome run_sweep(const Engine& engine, const SweepPlan& plan, ResultFile& file,
                       const SweepOptions& options) {
  return Sweeper(engine, plan, file, options).run();
}

}  // namespace shakedown
