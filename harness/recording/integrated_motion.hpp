// SPDX-License-Identifier: MIT
// Finds positions of a swing from a record of its velocity or acceleration (a gyro, a vibrometer, a phone).
// An integral knows neither its beginning nor a slow drift of the sensor's zero, so what is slower than the
// swing is taken out of it.
#pragma once
#include <string>
#include <vector>

namespace shakedown {

/// A quantity on whatever clock, one value a time.
struct TimeSeries {
  std::vector<double> time, value;  ///< s
  std::string why_not{};            ///< why there is none; empty: there is
};

/// Returns the integral of a swing, less its mean over two periods weighed by a triangle: the sensor's drift
/// goes, and of a swing that decays by d a period stays all but (d / 2 pi)^2, the phase slipping by as
/// little. One period is lost at either end, where there is no such mean. Values that are no number are
/// stepped over. `why_not` where the record swings less than six times.
TimeSeries integral_of_swing(const TimeSeries& rate);

}  // namespace shakedown
