// SPDX-License-Identifier: MIT
// A comparison whose tolerance is measured: it stands beside the error that was seen, and is at most twenty
// times as large. Larger ones would let a mistake pass.
#pragma once
#include <gtest/gtest.h>

/// |value - expected| <= tolerance; `seen` is the largest error seen when the test was written.
#define WITHIN(value, expected, tolerance, seen)                                                     \
  do {                                                                                               \
    static_assert((tolerance) > 0 && (tolerance) <= 20 * (seen), "at most 20 times the error seen"); \
    EXPECT_NEAR(value, expected, tolerance);                                                         \
  } while (false)
