// SPDX-License-Identifier: MIT
// The few statistics that audits, comparisons and diagnoses share.
#pragma once
#include <vector>

#include "distributions.hpp"  // for those that find the tails here

namespace shakedown {

/// Returns the median of those that are numbers: NaN among them is left out. NaN when there is nothing.
double median(std::vector<double> values);

/// The median of the steps from one to the next; NaN where there are fewer than two.
double typical_interval(const std::vector<double>& ascending);

/// Returns the standard deviation of a normal distribution with this median absolute deviation from the
/// median: 1.4826 MAD.
double robust_deviation(const std::vector<double>& values);

}  // namespace shakedown
