// SPDX-License-Identifier: MIT
// Tails of the distributions that tests and intervals use. Incomplete gamma and beta functions are Eigen's
// (unsupported/Eigen/SpecialFunctions, after Cephes).
#pragma once

namespace shakedown {

/// |standard normal| stays below this with probability 0.95: half the width of a 95 % interval in standard
/// errors.
constexpr double normal_95 = 1.959963984540054;

/// Returns the probability that chi-squared with `degrees` > 0 of freedom exceeds `value`; NaN of NaN.
/// Relative error below 1e-12.
double chi_squared_tail(double value, double degrees);

/// Returns the probability that |Student's t| exceeds `value` >= 0; degrees of freedom real and positive.
double student_two_sided_tail(double value, double degrees_of_freedom);

/// Returns t with P(|T| < t) = 0.95 for Student's distribution; degrees of freedom real and at least 1.
double student_95(double degrees_of_freedom);

}  // namespace shakedown
