// SPDX-License-Identifier: MIT
#pragma once
#include <span>

namespace shakedown {

/// Value at x on the straight line between the two samples about it; NaN outside of them and without samples.
/// The places ascend; as many values as places.
double interpolated(std::span<const double> places, std::span<const double> values, double x);

}  // namespace shakedown
