// SPDX-License-Identifier: MIT
// A forced damper as a person compares it: amplitude, lag, loss factor and effective mass by the very frames.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decay_comparison.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "measurements.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double acceleration = 0.3, frequency = 1.05;  // m/s^2, Hz

shakedown::Setup forced(int grains) {
  shakedown::Setup setup;
  setup.grains.count = grains;
  setup.box.length = 0.065;
  setup.release.displacement = 0.02;
  setup.run.duration = 30;
  set_number(setup, "oscillating_acceleration.amplitude.x", acceleration, all_effects());
  set_number(setup, "oscillating_acceleration.frequency", frequency, all_effects());
  return setup;
}

std::vector<DecayComparison> compared(const shakedown::Setup& truth, const shakedown::Setup& believed,
                                      RecordingSettings recording = {}) {
  const auto engine = engine_named("hard");
  const Experiment experiment =
      make_measurements(truth, {{"forced", {}}}, recording, {engine.get(), all_effects(), 3, 1, nullptr});
  const Workshop workshop{engine.get(), all_effects(), {1}};
  return compare_decay(measurement_of(believed, experiment, all_effects()), workshop, 2, 1);
}

}  // namespace

// Amplitude a M / sqrt((k - M w^2)^2 + (c w)^2) and its lag.
TEST(DecayComparison, AForcedEmptyBoxHasTheClosedForm) {
  const double damping = 0.8, mass = 0.434, w = 2 * std::numbers::pi * frequency,
               k = mass * std::pow(2 * std::numbers::pi * 1.23, 2);
  shakedown::Setup truth = forced(0);
  set_number(truth, "blade_viscous_damping.damping", damping, all_effects());
  const std::vector<DecayComparison> runs = compared(truth, truth);
  ASSERT_EQ(runs.size(), 1u);
  ASSERT_TRUE(runs[0].forced);
  const ForcedComparison& seen = *runs[0].forced;
  const double amplitude = mass * acceleration / std::hypot(k - mass * w * w, damping * w);
  WITHIN(seen.amplitude.model / amplitude, 1, 1e-3, 1.4e-4);
  WITHIN(seen.amplitude.measured / amplitude, 1, 0.02,
         0.015);  // half of highest less lowest: noise adds to it
  WITHIN(seen.phase_lag.measured, std::atan2(damping * w, k - mass * w * w), 2e-3, 6e-4);
  WITHIN(seen.loss_factor.measured / (damping * w / k), 1, 0.05, 0.029);
  EXPECT_TRUE(std::isnan(seen.effective_mass.measured));
}

TEST(SlowDecayComparison, GrainsOfAnotherRestitutionLoseOtherwise) {
  const shakedown::Setup truth = forced(37);
  shakedown::Setup believed = truth;
  believed.restitution.grain_grain = 0.6;
  const std::vector<DecayComparison> right = compared(truth, truth), wrong = compared(truth, believed);
  ASSERT_TRUE(right.at(0).forced && wrong.at(0).forced);
  const MeasuredNumber &of_right = right[0].forced->amplitude, &of_wrong = wrong[0].forced->amplitude;
  WITHIN(of_right.model / of_right.measured, 1, 0.05, 0.02);
  EXPECT_LT(of_wrong.model, 0.9 * of_wrong.measured);
  EXPECT_TRUE(std::isfinite(right[0].forced->effective_mass.measured));
}

TEST(DecayComparison, NothingIsSaidOfADamperThatIsLeftToItselfOrSeldomFilmed) {
  shakedown::Setup free = forced(0);
  free.effects.clear();
  EXPECT_FALSE(compared(free, free).at(0).forced);
  RecordingSettings slow;
  slow.frame_rate = 15;  // 14 frames a cycle
  EXPECT_FALSE(compared(forced(0), forced(0), slow).at(0).forced);
}

// Livelier grains make a thicker layer; the right model tells each landing within some spreads.
TEST(DecayComparison, LandingsTellLooserGrains) {
  shakedown::Setup truth;
  truth.box.length = 0.065;
  truth.run.duration = 6;
  shakedown::Setup believed = truth;
  believed.restitution.grain_grain = 0.9;
  const std::vector<DecayComparison> right = compared(truth, truth), wrong = compared(truth, believed);
  const std::vector<LandingComparison>& landings = right.at(0).landings;
  ASSERT_GE(landings.size(), 8u);
  const auto mean = [](const std::vector<DecayComparison>& runs, std::string_view key) {
    for (const LandingRow& row : landing_rows())
      if (row.key == key) return mean_of(runs.at(0).landings, row);
    return MeasuredNumber{};
  };
  const MeasuredNumber thickness = mean(right, "thickness_mm"), momentum = mean(right, "momentum_mn_s");
  WITHIN(thickness.model / thickness.measured, 1, 0.05, 0.01);
  WITHIN(momentum.model / momentum.measured, 1, 0.05, 0.01);
  EXPECT_GT(mean(wrong, "thickness_mm").model, 1.03 * thickness.measured);
  EXPECT_NE(told(landings).find("given to the wall"), std::string::npos);
}
