// SPDX-License-Identifier: MIT
#include "ensemble.hpp"

#include <gtest/gtest.h>

#include "closed_form_engine.hpp"
#include "summary_file.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

shakedown::Setup quick_setup() {
  shakedown::Setup setup;
  setup.run.duration = 6;
  setup.run.sample_rate = 100;
  return setup;
}

EnsembleOptions runs_on(int runs, int threads) {
  EnsembleOptions options;
  options.runs = runs;
  options.execution.threads = threads;
  return options;
}

}  // namespace

TEST(Ensembles, SameBytesForAnyNumberOfThreads) {
  const ClosedFormEngine engine;
  const shakedown::Setup setup = quick_setup();
  const std::string alone = summary_json(run_ensemble(engine, setup, runs_on(40, 1)), setup);
  for (const int threads : {2, 5})
    EXPECT_EQ(summary_json(run_ensemble(engine, setup, runs_on(40, threads)), setup), alone);
}

TEST(Ensembles, ARunCanBeMadeAlone) {
  const ClosedFormEngine engine;
  const shakedown::Setup setup = quick_setup();
  const Ensemble all = run_ensemble(engine, setup, runs_on(5, 2));
  EnsembleOptions only_fourth = runs_on(1, 1);
  only_fourth.first_run = 3;
  const Ensemble fourth = run_ensemble(engine, setup, only_fourth);
  EXPECT_EQ(fourth.runs[0].run, 3);
  EXPECT_EQ(fourth.runs[0].observables.slope, all.runs[3].observables.slope);
  EXPECT_NE(all.runs[2].observables.slope, all.runs[3].observables.slope);
}

TEST(Ensembles, HandsOutEveryRunInOrderAndDropsSamples) {
  const ClosedFormEngine engine;
  const shakedown::Setup setup = quick_setup();
  EnsembleOptions options = runs_on(12, 3);
  std::vector<int> order;
  options.each = [&](int run, const Trajectory& trajectory, const Observables&) {
    order.push_back(run);
    EXPECT_EQ(trajectory.time.size(), 601u);
  };
  const Ensemble dropped = run_ensemble(engine, setup, options);
  for (int run = 0; run < 12; ++run) EXPECT_EQ(order[static_cast<std::size_t>(run)], run);
  EXPECT_TRUE(dropped.runs[0].trajectory.time.empty());
  EXPECT_EQ(dropped.runs[5].trajectory.collisions[0], 1005);
  options.keep_samples = true;
  EXPECT_EQ(run_ensemble(engine, setup, options).runs[7].trajectory.x_box.size(), 601u);
}

TEST(Ensembles, ProgressEndsAtOne) {
  const ClosedFormEngine engine;
  EnsembleOptions options = runs_on(7, 2);
  double last = 0;
  bool backwards = false;
  options.progress = [&](double fraction) {
    backwards = backwards || fraction < last - 1e-12;
    last = fraction;
  };
  run_ensemble(engine, quick_setup(), options);
  EXPECT_FALSE(backwards);
  WITHIN(last, 1, 4e-13, 2.2e-14);
}

TEST(Ensembles, StoppingKeepsFinishedRunsOnly) {
  ClosedFormEngine engine;
  std::atomic<bool> stop{false};
  engine.raise = &stop;
  engine.raising_run = 4;
  EnsembleOptions options = runs_on(10, 1);
  options.execution.stop = &stop;
  const Ensemble ensemble = run_ensemble(engine, quick_setup(), options);
  EXPECT_TRUE(ensemble.interrupted);
  ASSERT_EQ(ensemble.runs.size(), 4u);
  for (const RunResult& run : ensemble.runs) EXPECT_FALSE(run.trajectory.interrupted);
}

TEST(Ensembles, StoppingASingleRunKeepsWhatIsDone) {
  ClosedFormEngine engine;
  std::atomic<bool> stop{false};
  engine.raise = &stop;
  engine.raising_run = 0;
  EnsembleOptions options = runs_on(1, 1);
  options.execution.stop = &stop;
  const Ensemble ensemble = run_ensemble(engine, quick_setup(), options);
  EXPECT_TRUE(ensemble.interrupted);
  ASSERT_EQ(ensemble.runs.size(), 1u);
  WITHIN(ensemble.runs[0].trajectory.end_time, 2.99, 1e-14, 6.7e-16);
  EXPECT_EQ(ensemble.runs[0].observables.peaks.size(), 6u);
}

TEST(Ensembles, AnEngineThatBreaksItsPromiseIsHeard) {
  ClosedFormEngine engine;
  engine.failing_run = 6;
  for (const int threads : {1, 3})
    EXPECT_THROW(run_ensemble(engine, quick_setup(), runs_on(10, threads)), PhysicsError);
}

TEST(Ensembles, MeanAndSpreadOverRuns) {
  const ClosedFormEngine engine;
  const shakedown::Setup setup = quick_setup();
  const Ensemble ensemble = run_ensemble(engine, setup, runs_on(30, 2));
  std::vector<double> rates;
  for (int run = 0; run < 30; ++run) rates.push_back(ClosedFormEngine::rate_of(setup, run));
  const Statistic expected = statistic_of(rates);
  const Statistic seen =
      ensemble.over_runs([](const RunResult& run) { return run.observables.decay.exponential.rate; });
  EXPECT_EQ(seen.n, 30);
  WITHIN(seen.mean, expected.mean, 8e-8, 4e-9);  // 1/s
  WITHIN(seen.sd, expected.sd, 1e-8, 9.9e-10);
}
