// SPDX-License-Identifier: MIT
// Chooses where an axis begins and ends, and the numbers that stand at it.
#pragma once
#include <string>
#include <vector>

namespace shakedown {

struct Axis {
  double low = 0, high = 1;  ///< in the axis' unit
  std::vector<double> ticks;
  std::vector<std::string> labels;  ///< of the ticks
};

/// Returns an axis from `low` to `high`, finite, with about `wanted` ticks, three at least, at multiples of
/// 1, 2 or 5 times a power of ten. It is widened where both are one number. `rounded`: ends are ticks.
Axis axis_of(double low, double high, int wanted, bool rounded);

}  // namespace shakedown
