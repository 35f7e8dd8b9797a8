// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <limits>
#include <vector>

namespace shakedown {

/// What stands where there is no number.
inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The values that are numbers, in order.
inline std::vector<double> finite_of(const std::vector<double>& values) {
  std::vector<double> kept;
  for (const double value : values)
    if (std::isfinite(value)) kept.push_back(value);
  return kept;
}

}  // namespace shakedown
