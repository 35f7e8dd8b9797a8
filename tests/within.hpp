// SPDX-License-Identifier: MIT
// A comparison whose tolerance is measured: it stands beside the error that was seen, and is at most twenty
// times as large. A larger one would let a mistake pass.
#pragma once
#include <gtest/gtest.h>

/// Does not compile when the tolerance is no such one.
consteval double checked_tolerance(double tolerance, double seen) {
  if (!(tolerance > 0 && tolerance <= 20 * seen)) throw "a tolerance is at most 20 times the error seen";
  return tolerance;
}

/// |value - expected| <= tolerance; `seen` is the largest error seen when the test was written.
#define WITHIN(value, expected, tolerance, seen) \
  EXPECT_NEAR(value, expected, checked_tolerance(tolerance, seen))
