// SPDX-License-Identifier: MIT
#include "axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {

double step_of(double length, int wanted) {
  const double rough = length / std::max(1, wanted), power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

/// Returns the number at a tick, with a minus that is as wide as a digit.
std::string label_of(double value, double step) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  if (std::abs(value) < 0.5 * step) value = 0;
  const std::string digits = fmt::format("{:.{}f}", std::abs(value), decimals);
  return value < 0 ? "\u2212" + digits : digits;
}

}  // namespace

Axis axis_of(double low, double high, int wanted, bool rounded) {
  wanted = std::max(1, wanted);
  if (!(high > low)) {
    const double margin = low != 0 ? 0.1 * std::abs(low) : 1;
    low -= margin, high += margin;
  }
  constexpr std::size_t fewest = 3;
  Axis axis;
  for (; axis.ticks.size() < fewest; wanted *= 2) {
    const double step = step_of(high - low, wanted);
    axis = {low, high, {}, {}};
    if (rounded)
      axis.low = step * std::floor(low / step + 1e-9), axis.high = step * std::ceil(high / step - 1e-9);
    const double first = std::ceil(axis.low / step - 1e-9), last = std::floor(axis.high / step + 1e-9);
    for (double k = first; k <= last; ++k) {
      axis.ticks.push_back(k * step);
      axis.labels.push_back(label_of(k * step, step));
    }
  }
  return axis;
}

}  // namespace shakedown
