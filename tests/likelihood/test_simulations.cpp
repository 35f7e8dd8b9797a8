// SPDX-License-Identifier: MIT
// Where simulations of a fit are found or made: shared, kept on disk, on any number of threads.
#include <gtest/gtest.h>

#include <atomic>

#include "damped_oscillation.hpp"
#include "effects.hpp"
#include "refit.hpp"
#include "scratch_folder.hpp"

using namespace shakedown;

namespace {

TEST(EnsembleCache, ChangesNoAnswerAndSimulatesOnce) {
  const DampedOscillation engine;
  Workshop workshop{&engine, all_effects(), {2}};
  RefitOptions options;
  options.count = 32;
  shakedown::Setup longer = believed_setup();
  longer.run.duration = 9;
  const std::vector<MeasuredFeatures> first = measured_on(believed_setup(), believed_setup(), 1),
                                      second = measured_on(longer, believed_setup(), 2);
  const Refit alone = refit(first, {}, workshop, options), other_alone = refit(second, {}, workshop, options);
  EnsembleCache cache;
  workshop.store.recordings = &cache;
  EXPECT_EQ(refit(second, {}, workshop, options).chi2, other_alone.chi2);
  EXPECT_EQ(cache.reused(), 0);
  // shorter runs are the beginnings of longer ones
  EXPECT_EQ(refit(first, {}, workshop, options).chi2, alone.chi2);
  EXPECT_EQ(cache.reused(), 64);
}

class CountingEngine final : public Engine {
 public:
  std::string_view name() const override { return inner_.name(); }
  Capability can_model(const EffectRecord& record) const override { return inner_.can_model(record); }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    ++runs;
    return inner_.run(setup, options);
  }
  mutable std::atomic<int> runs = 0;

 private:
  DampedOscillation inner_;
};

TEST(SimulationJournal, WhatItHoldsIsNotSimulatedAgainAndTheAnswerIsTheSame) {
  const CountingEngine engine;
  Workshop workshop{&engine, all_effects(), {2}};
  RefitOptions options;
  options.count = 48;
  const std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  const Refit alone = refit(measured, theta, workshop, options);
  const int whole = engine.runs.exchange(0);
  const ScratchFolder folder;
  {
    SimulationJournal journal(folder / "journal", "test", false);
    workshop.store.journal = &journal;
    emulate(measured, theta, 64, options.first_run + 10000, workshop);  // as if interrupted after a round
    EXPECT_EQ(journal.kept(), 128);
  }
  engine.runs = 0;
  SimulationJournal journal(folder / "journal", "test", true);
  workshop.store.journal = &journal;
  EXPECT_EQ(journal.kept(), 128);
  const Refit resumed = refit(measured, theta, workshop, options);
  EXPECT_EQ(engine.runs, whole - 128);
  EXPECT_EQ(resumed.chi2, alone.chi2);
  engine.runs = 0;
  EXPECT_EQ(refit(measured, theta, workshop, options).chi2, alone.chi2);
  EXPECT_EQ(engine.runs, 0);
}

TEST(Refit, GivesTheSameAnswerForAnyNumberOfThreads) {
  const DampedOscillation engine;
  const std::vector<MeasuredFeatures> measured = measured_on(believed_setup(), believed_setup(), 1);
  RefitOptions options;
  options.count = 64;
  const Refit one = refit(measured, theta, {&engine, all_effects(), {1}}, options);
  const Refit three = refit(measured, theta, {&engine, all_effects(), {3}}, options);
  for (std::size_t k = 0; k < one.values.size(); ++k) EXPECT_EQ(one.values[k].value, three.values[k].value);
  EXPECT_EQ(one.chi2, three.chi2);
}

}  // namespace
