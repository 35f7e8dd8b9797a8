// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

namespace shakedown {

/// Returns x (m, NaN where missing) without the frames that no neighbour supports: they become missing.
/// `interval`: s between frames; `deviation`: m, of one frame's noise.
std::vector<double> without_outliers(const std::vector<double>& time, const std::vector<double>& x,
                                     double interval, double deviation);

}  // namespace shakedown
