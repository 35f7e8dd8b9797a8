// SPDX-License-Identifier: MIT
// What every comparison varies, and what a component test tells of an effect, as knobs.
#include "parameter_knobs.hpp"

#include <gtest/gtest.h>

#include "effects.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(ParameterKnobs, StayWithinWhatTheKeysMayBe) {
  for (const double restitution : {0.02, 0.2, 0.75, 0.995, 1.0}) {
    shakedown::Setup setup;
    setup.restitution.grain_wall = restitution;
    for (const std::vector<Knob>& knobs : {as_given(setup), free_parameters(setup)})
      for (const Knob& knob : knobs) {
        EXPECT_LE(knob.low, knob.centre) << knob.key << ' ' << restitution;
        EXPECT_GE(knob.high, knob.centre) << knob.key << ' ' << restitution;
        if (knob.key.starts_with("restitution")) {
          EXPECT_GE(knob.low, 0);
          EXPECT_LE(knob.high, 1);
        }
      }
  }
}

TEST(ParameterKnobs, AnEmptyBoxHasNoRestitutions) {
  shakedown::Setup setup;
  setup.grains.count = 0;
  for (const std::vector<Knob>& knobs : {as_given(setup), free_parameters(setup)}) {
    ASSERT_EQ(knobs.size(), 1u);
    EXPECT_EQ(knobs.front().key, "spring.frequency");
  }
}

TEST(ParameterKnobs, ANumberOfAnEffectIsFreeWithinItsError) {
  const std::string key = "grain_friction.grain_wall";
  const std::vector<KnownValue> known{{key, 0.2, 0.03, {}}};
  const std::vector<Knob> given = as_given({}, known, all_effects()),
                          fitted = believed(free_parameters(shakedown::Setup{}), known, all_effects());
  for (const std::vector<Knob>* knobs : {&given, &fitted}) {
    ASSERT_EQ(knobs->size(), 4u);
    EXPECT_EQ(knobs->back().key, key);
    EXPECT_EQ(knobs->back().centre, 0.2);
    EXPECT_EQ(knobs->back().believed, 0.2);
    EXPECT_EQ(knobs->back().believed_error, 0.03);
  }
  // As given it stays near; a fit may find it anywhere.
  WITHIN(given.back().low, 0.2 - 2.5 * 0.03, 5e-16, 2.8e-17);
  EXPECT_EQ(fitted.back().low, 0);
}

TEST(ParameterKnobs, WhatIsKnownExactlyIsNoKnob) {
  const std::vector<KnownValue> known{{"grain_friction.grain_wall", 0.2, 0, {}}};
  EXPECT_EQ(as_given({}, known, all_effects()).size(), 3u);
  EXPECT_EQ(believed(free_parameters(shakedown::Setup{}), known, all_effects()).size(), 3u);
}
