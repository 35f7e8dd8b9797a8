// SPDX-License-Identifier: MIT
#pragma once
#include <limits>

#include "distributions.hpp"

namespace shakedown {

struct Interval {
  double low = 0, high = 0;
  bool contains(double value) const { return low <= value && value <= high; }  ///< its ends included
};

/// A number with its 95 % interval, in whatever unit its owner names.
struct Estimate {
  double value = 0;
  double low = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the interval is not known
  double high = std::numeric_limits<double>::quiet_NaN();

  /// Returns the value with the 95 % interval of a normal distribution.
  static Estimate with_error(double value, double standard_error) {
    return {value, value - normal_95 * standard_error, value + normal_95 * standard_error};
  }
  double standard_error() const { return (high - low) / (2 * normal_95); }
};

}  // namespace shakedown
