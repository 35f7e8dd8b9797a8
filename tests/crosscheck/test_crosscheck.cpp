// SPDX-License-Identifier: MIT
#include "crosscheck.hpp"
#include "within.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

using namespace shakedown;

TEST(Crosscheck, AStraightLineReachesZeroExactly) {
  const std::array<double, 4> x{3, 1, 0.3, 0.1}, errors{0.1, 0.2, 0.1, 0.3};
  std::array<double, 4> y{};
  for (std::size_t i = 0; i < 4; ++i) y[i] = -8.17 + 0.09 * x[i];
  const LineAtZero line = line_at_zero(x, y, errors);
  WITHIN(line.value, -8.17, 3e-14, 1.9e-15);
  WITHIN(line.chi_squared, 0, 1e-26, 6e-28);  // the square of a rounding
}

TEST(Crosscheck, TwoPointsGiveTheErrorOfTheirExtrapolation) {
  // y(0) = 2 y(1) - y(2)
  const LineAtZero line = line_at_zero(std::array{1.0, 2.0}, std::array{5.0, 7.0}, std::array{0.3, 0.4});
  WITHIN(line.value, 3, 1e-14, 6.7e-16);
  WITHIN(line.error, std::hypot(0.6, 0.4), 3e-15, 1.7e-16);
}

TEST(Crosscheck, MarginsOfTheSlopeGoByLengthUnlessGiven) {
  EXPECT_DOUBLE_EQ(slope_margin({}, 0.040, -8e-3), 1e-4);
  EXPECT_DOUBLE_EQ(slope_margin({}, 0.104, -22e-3), 8e-4);
  EXPECT_DOUBLE_EQ(slope_margin({}, 0.311, -20e-3), 6e-4);
  EXPECT_DOUBLE_EQ(slope_margin({.slope = 2e-3}, 0.040, -8e-3), 2e-3);
}

TEST(Crosscheck, AnEngineIsEquivalentToItself) {
  shakedown::Setup setup;
  setup.run.duration = 3;
  setup.run.sample_rate = 200;
  CrosscheckOptions options;
  options.engines = {"hard", "hard"};
  options.runs = 3;
  options.margins.slope = 1;
  options.margins.frequency = options.margins.share = 1;
  const Crosscheck found = crosscheck("short", setup, options);
  ASSERT_EQ(found.comparisons.size(), 4u);  // too short for a frequency
  for (const Comparison& comparison : found.comparisons) {
    EXPECT_EQ(comparison.found.difference, 0);
    EXPECT_EQ(comparison.found.verdict, Agreement::equivalent) << comparison.number->key;
  }
}
