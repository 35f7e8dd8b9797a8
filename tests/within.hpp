// SPDX-License-Identifier: MIT
// Comparisons of numbers whose tolerance is measured: it stands beside the error that was seen, and is at
// most twenty times as large, which is checked when the test is compiled. A larger one would let a mistake
// pass.
//
// * A tolerance relative to a scale is written as a ratio: WITHIN(value / scale, expected / scale, 1e-9,
// 2e-10).
// * Where nothing but rounding was seen, `seen` is at least one unit in the last place of the numbers
// compared,
//   2.2e-16 of them: another processor or compiler may round elsewhere.
// * Where a number is drawn and its error differs from seed to seed, `seen` is its standard error.
// * A reading that is rounded, as a paper's "approximately 0.15", has half of its last digit as `seen`.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

/// A tolerance and the error that was seen. Does not compile when it is more than twenty times as large.
struct Tolerance {
  double size, seen;
  consteval Tolerance(double tolerance, double error) : size(tolerance), seen(error) {
    if (!(tolerance > 0 && tolerance <= 20 * error)) throw "a tolerance is at most 20 times the error seen";
  }
};

/// Where an error is only bounded from above.
consteval double checked_tolerance(double tolerance, double seen) { return Tolerance(tolerance, seen).size; }

/// With WITHIN_SEEN=FILE in the environment each comparison adds a line: place, error, tolerance, seen.
inline void note_seen(const char* file, int line, double error, const Tolerance& tolerance) {
  const char* const path = std::getenv("WITHIN_SEEN");
  if (path == nullptr) return;
  static std::ofstream notes(path, std::ios::app);
  notes << file << ":" << line << " " << error << " " << tolerance.size << " " << tolerance.seen << "\n";
}

inline testing::AssertionResult within_tolerance(const char* value_text, const char* expected_text,
                                                 const char*, double value, double expected,
                                                 const Tolerance& tolerance,
                                                 const char* file = __builtin_FILE(),
                                                 int line = __builtin_LINE()) {
  const double off = value - expected;
  note_seen(file, line, std::abs(off), tolerance);
  if (std::abs(off) <= tolerance.size) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value_text << " is " << value << ", " << expected_text << " is "
                                     << expected << ": " << off << " off, more than " << tolerance.size;
}

/// |value - expected| <= tolerance; `seen` is the largest error seen when the test was written. The two may
/// be a Tolerance, where cases differ: WITHIN(value, expected, exact ? Tolerance(1e-12, 6e-14) : rough).
#define WITHIN(value, expected, ...) \
  EXPECT_PRED_FORMAT3(within_tolerance, value, expected, Tolerance(__VA_ARGS__))
#define ASSERT_WITHIN(value, expected, ...) \
  ASSERT_PRED_FORMAT3(within_tolerance, value, expected, Tolerance(__VA_ARGS__))

/// How many standard errors a drawn number may be off; does not compile when it is more than five.
consteval double checked_errors(double errors) {
  if (!(errors > 0 && errors <= 5)) throw "a number is at most five standard errors off";
  return errors;
}

inline testing::AssertionResult within_errors(const char* value_text, const char* expected_text, const char*,
                                              const char* error_text, const char*, double value,
                                              double expected, double errors, double error, double seen) {
  if (!(error > 0 && error <= 2 * seen))
    return testing::AssertionFailure() << error_text << " is " << error << ": the standard error seen is "
                                       << seen << ", and at most twice that is allowed";
  const double off = (value - expected) / error;
  if (off >= -errors && off <= errors) return testing::AssertionSuccess();
  return testing::AssertionFailure() << value_text << " is " << value << ", " << expected_text << " is "
                                     << expected << ": " << off << " standard errors of " << error
                                     << " off, more than " << errors;
}

/// |value - expected| <= errors * error, where the standard error is computed, often by what is tested: it is
/// at most twice the one `seen`, so that no test passes because an error grew.
#define WITHIN_ERRORS(value, expected, errors, error, seen) \
  EXPECT_PRED_FORMAT5(within_errors, value, expected, checked_errors(errors), error, seen)
