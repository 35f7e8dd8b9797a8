// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>

#include "effects.hpp"
#include "setup_file.hpp"
#include "steady_pull.hpp"

using namespace shakedown;

namespace {

using DamperSetup = shakedown::Setup;

DamperSetup pulled(const std::string& axis, double pull) {
  return with_overrides(
      DamperSetup{},
      std::vector<Override>{{"constant_acceleration.acceleration." + axis, std::to_string(pull) + " m/s^2"}},
      all_effects());
}

}  // namespace

TEST(SteadyPull, OfGrainsAndBoxHoldsTheBoxWhereTheirWeightStretchesTheSpring) {
  const double w = 2 * std::numbers::pi * 1.23, weight = (0.434 + 37 * 4.04e-3) * -2;
  const SteadyPull pull = steady_pull(pulled("x", -2));
  EXPECT_DOUBLE_EQ(pull.rest, weight / (0.434 * w * w));
  EXPECT_DOUBLE_EQ(pull.shaking, w * w * (0.1075 - pull.rest));
  EXPECT_DOUBLE_EQ(pull.ratio(), pull.shaking / 2);
}

TEST(SteadyPull, IsToldWithItsNumbersAndWarnsWhereLayersRestAlongTheMotion) {
  EXPECT_EQ(words_of_pull(steady_pull(DamperSetup{})), "");
  EXPECT_EQ(note_on_pull(steady_pull(DamperSetup{})), "");
  EXPECT_EQ(words_of_pull(steady_pull(pulled("z", -2))), "3.21 (6.42 m/s^2 against 2 m/s^2)");
  const auto warns = [](const std::string& axis, double pull) {
    return note_on_pull(steady_pull(pulled(axis, pull))).find("crosscheck") != std::string::npos;
  };
  EXPECT_TRUE(warns("x", -3));
  EXPECT_FALSE(warns("x", -1));
  EXPECT_FALSE(warns("z", -3));
}
