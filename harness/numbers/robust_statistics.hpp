// SPDX-License-Identifier: MIT
// The few statistics that audits, comparisons and diagnoses share.
#pragma once
#include <vector>

namespace shakedown {

/// NaN when there is nothing.
double median(std::vector<double> values);

/// Standard deviation of a normal distribution with this median absolute deviation from the median: 1.4826
/// MAD.
double robust_deviation(const std::vector<double>& values);

/// Probability that chi-squared with `degrees` of freedom exceeds `value` (regularised incomplete gamma
/// function; series and continued fraction, Abramowitz and Stegun 6.5.29, 6.5.31). Relative error below
/// 1e-10.
double chi_squared_tail(double value, double degrees);

/// Probability that |standard normal| exceeds `value`.
double normal_two_sided_tail(double value);

/// z with P(standard normal < z) = probability, 0 < probability < 1 (Acklam's rational fit and one Halley
/// step; 1e-15).
double normal_quantile(double probability);

}  // namespace shakedown
