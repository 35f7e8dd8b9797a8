// SPDX-License-Identifier: MIT
#include "distributions.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "interval.hpp"
#include "within.hpp"

using namespace shakedown;

// Values with 17 digits: incomplete gamma and beta functions in arithmetic of 40 digits.

TEST(Distributions, ChiSquaredTail) {
  // Two degrees of freedom: exp(-x/2).
  for (const double x : {0.1, 1.0, 9.0, 60.0})
    WITHIN(chi_squared_tail(x, 2) / std::exp(-x / 2), 1, 1e-14, 1.3e-15);
  struct {
    double degrees, value, tail;
  } const cases[] = {{1, 3.841458820694124, 0.0500000000000000574},
                     {100, 124.34211340400407, 0.0500000000000000931},
                     {800, 800, 0.493350870161094529},
                     {3000, 3300, 0.0000851384970727166842},
                     {1, 100, 1.52397060483210521e-23},
                     {6, 80, 3.57286592870022635e-15},
                     {15, 4, 0.997737344152916921}};
  for (const auto& one : cases)
    WITHIN(chi_squared_tail(one.value, one.degrees) / one.tail, 1, 5e-12, 4.9e-13);
  EXPECT_EQ(chi_squared_tail(0, 5), 1);
  EXPECT_EQ(chi_squared_tail(1e6, 3), 0);
}

/// A tail of 1 would let anything hold.
TEST(Distributions, WhatIsNoNumberHasNoTail) {
  EXPECT_TRUE(std::isnan(chi_squared_tail(std::nan(""), 5)));
  EXPECT_EQ(chi_squared_tail(INFINITY, 5), 0);
  EXPECT_EQ(chi_squared_tail(-INFINITY, 5), 1);
  EXPECT_TRUE(std::isnan(student_two_sided_tail(std::nan(""), 4)));
}

TEST(Distributions, StudentsTail) {
  WITHIN(student_two_sided_tail(3, 5), 0.0300992478974625738, 2e-16, 1.4e-17);
  WITHIN(student_two_sided_tail(40, 9) / 1.89829984493398265e-11, 1, 2e-14, 1.8e-15);
  WITHIN(student_two_sided_tail(0.01, 4), 0.992500156245898547, 1e-13, 1.2e-14);
  EXPECT_EQ(student_two_sided_tail(0, 4), 1);
}

TEST(Distributions, StudentsQuantiles) {
  struct {
    double degrees, t;
  } const cases[] = {{1, 12.7062047361747046},       {2, 4.30265272974946385},  {7, 2.36462425159278534},
                     {12.3288, 2.17238560227481812}, {30, 2.04227245630123831}, {1000, 1.96233908082640848},
                     {1e6, 1.95996635681410704}};
  for (const auto& one : cases) WITHIN(student_95(one.degrees), one.t, 1e-9, 1.6e-10);
}

TEST(Distributions, NormalIntervalHoldsNinetyFivePercent) {
  WITHIN(std::erfc(normal_95 / std::sqrt(2)), 0.05, 4e-16, 3.5e-17);
  const Estimate estimate = Estimate::with_error(3, 0.5);
  EXPECT_DOUBLE_EQ(estimate.standard_error(), 0.5);
  EXPECT_DOUBLE_EQ(estimate.low, 3 - 0.5 * normal_95);
  EXPECT_TRUE((Interval{estimate.low, estimate.high}.contains(3.9)));
  EXPECT_FALSE((Interval{estimate.low, estimate.high}.contains(4.0)));
}
