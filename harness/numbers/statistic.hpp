// SPDX-License-Identifier: MIT
#pragma once
#include <limits>
#include <span>

namespace shakedown {

/// Mean, standard deviation (of one value, n - 1 in the denominator) and number of the values that are
/// present.
struct Statistic {
  double mean = std::numeric_limits<double>::quiet_NaN();  ///< NaN without values
  double sd = std::numeric_limits<double>::quiet_NaN();    ///< NaN with fewer than two
  int n = 0;
};

/// Returns mean, standard deviation and number of the values; NaN counts as absent.
Statistic statistic_of(std::span<const double> values);

}  // namespace shakedown
