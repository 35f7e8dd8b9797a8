// SPDX-License-Identifier: MIT
#pragma once
#include <span>

namespace shakedown {

/// Returns the value at x on the straight line between the two samples about it; NaN outside of them and
/// without samples. The places ascend; there are as many values as places.
double interpolated(std::span<const double> places, std::span<const double> values, double x);

/// Returns the value at x of the curve of cubics through the points that rises and falls only where they do;
/// before the first point and after the last it keeps their values. It needs two points or more, whose places
/// ascend strictly.
/// Source: F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5, 300 (1984), their weighted harmonic
/// mean of the slopes on both sides; at an end a parabola's slope, limited so that the curve does not turn.
double monotone_cubic(std::span<const double> places, std::span<const double> values, double x);

}  // namespace shakedown
