// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <limits>
#include <vector>

namespace shakedown {

/// Stands where there is no number.
inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Returns the values that are finite, in order.
inline std::vector<double> finite_of(const std::vector<double>& values) {
  std::vector<double> kept;
  for (const double value : values)
    if (std::isfinite(value)) kept.push_back(value);
  return kept;
}

}  // namespace shakedown
