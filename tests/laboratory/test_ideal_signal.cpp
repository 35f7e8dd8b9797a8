// SPDX-License-Identifier: MIT
// The signal that an ideal judge has: nothing without a cause, in proportion to the cause, nothing of what a
// refit takes up.
#include "ideal_signal.hpp"

#include <gtest/gtest.h>

#include "effects.hpp"
#include "engines.hpp"
#include "hideable.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// Short runs of few grains: milliseconds each.
double signal_of(const std::vector<Override>& with, IdealIgnorance ignorance = {},
                 const shakedown::Setup& plain = {}) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const TrialTools tools{
      .laboratory = engine.get(), .model = engine.get(), .known = all_effects(), .execution = {1}};
  shakedown::Setup setup = plain;
  setup.grains.count = 12;
  setup.run.duration = 3;
  IdealSettings settings;
  settings.runs = runs_of_lengths({0.04});
  settings.ignorance = ignorance;
  settings.count = 16;
  return ideal_signal(setup, changed(setup, with, all_effects()), settings, tools);
}

std::vector<Override> damping(const char* strength) {
  return {{"blade_viscous_damping.damping", strength, ""}};
}

}  // namespace

TEST(IdealSignal, NothingHiddenIsNotSeen) {
  EXPECT_LT(signal_of({}), 2);  // its square is 0 +- 1 (60 bins, 16 simulations)
}

TEST(IdealSignal, GrowsInProportionToAWeakForce) {
  const double once = signal_of(damping("\"0.02 N s/m\"")), twice = signal_of(damping("\"0.04 N s/m\""));
  EXPECT_GT(once, 10);
  WITHIN(twice / once, 2, 0.5, 0.22);  // 2.2 was seen: the covariance of either is known to a tenth
}

TEST(IdealSignal, ASpringThatNobodyKnowsTakesUpItsOwnChange) {
  const std::vector<Override> tuned{{"spring.frequency", "\"1.2312 Hz\"", ""}};  // a thousandth
  IdealIgnorance knows;
  knows.frequency = 1e-6;
  EXPECT_GT(signal_of(tuned, knows), 10);
  EXPECT_LT(signal_of(tuned), 1);
}

TEST(IdealSignal, AParameterAtItsBoundIsMovedToOneSide) {
  shakedown::Setup elastic;
  elastic.restitution.grain_grain = 0.97;  // 1.02 is none
  EXPECT_GT(signal_of(damping("\"0.05 N s/m\""), {}, elastic), 10);
}
