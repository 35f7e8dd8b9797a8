// SPDX-License-Identifier: MIT
// Frames that are no numbers: the balance says that it has none, or gives numbers, and never lets a setup
// hold.
#include <gtest/gtest.h>

#include <cmath>

#include "effects.hpp"
#include "momentum.hpp"
#include "momentum_run.hpp"
#include "pushed_box.hpp"

namespace shakedown {
namespace {

MomentumAudit audited(const Experiment& experiment) {
  MomentumOptions options;
  options.formulas = false;
  return audit_momentum(measurement_of(pushed_setups(experiment), experiment), all_effects(), options);
}

void expect_honest(const MomentumAudit& audit) {
  const ModelTest none{0.5, 1, ""};
  for (const BalanceFit& fit : {audit.as_given, audit.refitted, audit.final_fit}) {
    const ModelTest test = audit.test_of(fit);
    if (!test.why_not.empty()) {
      EXPECT_FALSE(audit.possible);
      continue;
    }
    const bool is_probability = fit.p_value >= 0 && fit.p_value <= 1;
    EXPECT_EQ(judgement_of(none, test).holds(), is_probability && fit.p_value > balance_rejected);
  }
  EXPECT_EQ(audit.possible && audit.unexplained,
            audit.possible && !(audit.final_fit.p_value > balance_rejected));
  for (const FoundTerm& term : audit.terms)
    EXPECT_TRUE(std::isfinite(term.value) && std::isfinite(term.low) && std::isfinite(term.high))
        << term.key();
}

TEST(SlowNoNumbers, InSomeFramesLeaveTheRest) {
  for (const double bad : {std::nan(""), static_cast<double>(INFINITY)}) {
    PushedBox what;
    what.duration = 6;
    Experiment experiment = pushed_box(what, 3);
    for (MeasuredRun& run : experiment.runs)
      for (std::size_t i = 100; i < run.x_box.size(); i += 50) run.x_box[i] = bad, run.x_com[i + 7] = bad;
    const MomentumAudit audit = audited(experiment);
    expect_honest(audit);
    EXPECT_TRUE(audit.possible) << audit.why_not;
  }
}

TEST(NoNumbers, InAllFramesLeaveNoBalance) {
  for (const double bad : {std::nan(""), static_cast<double>(INFINITY)}) {
    Experiment experiment = pushed_box({}, 3);
    for (MeasuredRun& run : experiment.runs) {
      for (double& x : run.x_box) x = bad;
      for (double& x : run.x_com) x = bad;
    }
    const MomentumAudit audit = audited(experiment);
    expect_honest(audit);
    EXPECT_FALSE(audit.possible);
    EXPECT_FALSE(audit.why_not.empty());
  }
}

TEST(NoNumbers, WithoutTheGrainsCentreOrWithFewFramesARunHasNoMomentum) {
  const auto frames_of = [](std::size_t frames, bool centre) {
    Experiment experiment = pushed_box({}, 1);
    MeasuredRun& run = experiment.runs.front();
    for (std::vector<double>* series : {&run.time, &run.x_box, &run.x_com})
      series->resize(std::min(series->size(), frames));
    Measurement measurement = measurement_of(pushed_setups(experiment), experiment);
    if (!centre) measurement.runs.front().recorded.x_com.clear();
    return momentum_run(measurement.runs.front()).time.size();
  };
  EXPECT_GT(frames_of(1000, true), 900);
  EXPECT_EQ(frames_of(1000, false), 0);
  EXPECT_EQ(frames_of(MomentumRun::fewest_frames - 1, true), 0);
}

/// A box that never moves has no noise and no motion.
TEST(SlowNoNumbers, AreNotMadeOfABoxThatRests) {
  Experiment experiment = pushed_box({}, 3);
  for (MeasuredRun& run : experiment.runs) {
    for (double& x : run.x_box) x = 0.01;
    for (double& x : run.x_com) x = 0.01;
  }
  expect_honest(audited(experiment));
}

}  // namespace
}  // namespace shakedown
