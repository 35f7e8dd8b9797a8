// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

namespace shakedown {

/// Frames of x (m, NaN where missing) that no neighbour supports become missing; returns the series without
/// them. `interval` s between frames, `deviation` m of one frame's noise.
std::vector<double> without_outliers(const std::vector<double>& time, const std::vector<double>& x,
                                     double interval, double deviation);

}  // namespace shakedown
