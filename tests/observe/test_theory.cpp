// SPDX-License-Identifier: MIT
// The paper's own numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "friction_oscillator.hpp"
#include "theory.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(PaperEstimates, TheDamperOfTableOne) {
  const Theory theory = theory_of(shakedown::Setup{});
  WITHIN(theory.beam_stiffness, 25.39, 0.01, 9.7e-4);     // N/m; the paper prints 0.0254 N/mm
  WITHIN(theory.beam_frequency, 1.2176, 1e-3, 3e-4);      // Hz; the paper prints 1.217
  WITHIN(theory.stiffness, 25.92, 0.005, 1.5e-3);         // N/m
  WITHIN(theory.loaded_frequency, 1.0608, 1e-4, 8.5e-6);  // Hz
  EXPECT_DOUBLE_EQ(theory.layer_thickness, 0.020);
  WITHIN(theory.optimal_length, 0.3113, 5e-5, 3.4e-5);  // m
  EXPECT_EQ(theory.landing, LandingPhase::outward);
}

TEST(PaperEstimates, LongestMeasuredBoxAndOptimum) {
  shakedown::Setup setup;
  setup.box.length = 0.104;
  WITHIN(theory_of(setup).phase_through_box, 0.15, 0.01, 5.9e-3);  // "approximately 0.15"
  EXPECT_EQ(theory_of(setup).landing, LandingPhase::inward);
  setup.box.length = theory_of(setup).optimal_length;
  WITHIN(theory_of(setup).phase_through_box, 0.5, 2e-15, 1.2e-16);
  setup.domain = Domain::periodic;
  EXPECT_THROW(theory_of(setup), InputError);
}

TEST(FrictionOscillator, SolvesItsEquation) {
  const FrictionOscillator oscillator{25.92, 0.58348, 0.3, 0.1075};
  const double h = 1e-4;
  for (double t = 0.01; t < oscillator.last_extremum() * oscillator.half_period() - 0.01; t += 0.037) {
    const double into_half = std::remainder(t, oscillator.half_period());
    if (std::abs(into_half) < 2 * h) continue;  // friction jumps there
    const double x = oscillator.position_at(t), v = oscillator.velocity_at(t);
    const double acceleration = (oscillator.velocity_at(t + h) - oscillator.velocity_at(t - h)) / (2 * h);
    const double force = -oscillator.stiffness * x - oscillator.friction * (v > 0 ? 1 : -1);
    WITHIN(oscillator.total_mass * acceleration, force, 1e-6, 1.9e-7) << t;  // N
    WITHIN((oscillator.position_at(t + h) - oscillator.position_at(t - h)) / (2 * h), v, 1e-7, 4.8e-8) << t;
  }
}

TEST(FrictionOscillator, SticksWhereTheSpringIsWeakerThanFriction) {
  const FrictionOscillator oscillator{25.92, 0.58348, 0.3, 0.1075};
  const int last = oscillator.last_extremum();
  const double slip = oscillator.friction / oscillator.stiffness;
  EXPECT_LE(std::abs(oscillator.extremum(last).position), slip);
  EXPECT_GT(std::abs(oscillator.extremum(last - 1).position), slip);
  EXPECT_EQ(oscillator.velocity_at(100), 0);
  EXPECT_EQ(oscillator.position_at(100), oscillator.extremum(last).position);
}

TEST(FrictionOscillator, EffectiveFrictionIsReadBackFromAnyPeak) {
  const FrictionOscillator oscillator{25.92, 0.58348, 0.05, 0.1075};
  for (int n = 1; n <= 9; ++n)
    WITHIN(effective_friction(oscillator.stiffness, oscillator.release, oscillator.extremum(n).position, n),
           0.05, 1e-15, 5e-17);
}

TEST(FrictionOscillator, WithoutFrictionItIsTheLoadedSpring) {
  const FrictionOscillator oscillator{25.92, 0.58348, 0, 0.1075};
  const double angular = std::sqrt(25.92 / 0.58348);
  for (double t = 0; t < 5; t += 0.1)
    WITHIN(oscillator.position_at(t), 0.1075 * std::cos(angular * t), 1e-14, 6.1e-16);
}
