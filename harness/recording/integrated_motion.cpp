// SPDX-License-Identifier: MIT
#include "integrated_motion.hpp"

#include <algorithm>
#include <cmath>

#include "robust_statistics.hpp"
#include "rough_motion.hpp"

namespace shakedown {

namespace {

/// The integral of a piecewise linear series from the first time on, at any time.
class RunningIntegral {
 public:
  explicit RunningIntegral(const TimeSeries& series) : series_(series), sum_(series.time.size(), 0) {
    for (std::size_t i = 1; i < sum_.size(); ++i)
      sum_[i] =
          sum_[i - 1] + (series.value[i] + series.value[i - 1]) / 2 * (series.time[i] - series.time[i - 1]);
  }

  double at(double t) const {
    const auto& [time, value, why_not] = series_;
    const auto after = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
    const std::size_t i = std::clamp<std::size_t>(after, 1, time.size() - 1);
    const double part = t - time[i - 1], slope = (value[i] - value[i - 1]) / (time[i] - time[i - 1]);
    return sum_[i - 1] + part * (value[i - 1] + slope * part / 2);
  }
  /// Returns the integral at each time of the series.
  const std::vector<double>& at_rows() const { return sum_; }

 private:
  const TimeSeries& series_;
  std::vector<double> sum_;
};

/// Returns the mean over `width` (s) about each time that has half as much on either side.
TimeSeries moving_mean(const TimeSeries& series, double width) {
  const RunningIntegral integral(series);
  TimeSeries mean;
  for (const double t : series.time) {
    if (t - width / 2 < series.time.front() || t + width / 2 > series.time.back()) continue;
    mean.time.push_back(t);
    mean.value.push_back((integral.at(t + width / 2) - integral.at(t - width / 2)) / width);
  }
  return mean;
}

}  // namespace

TimeSeries integral_of_swing(const TimeSeries& rate) {
  TimeSeries whole;
  for (std::size_t i = 0; i < rate.time.size(); ++i)
    if (std::isfinite(rate.value[i]))
      whole.time.push_back(rate.time[i]), whole.value.push_back(rate.value[i]);
  constexpr double fewest_swings = 6;
  const double frequency = rough_motion(whole.time, whole.value).frequency, period = 1 / frequency;
  if (whole.time.size() < 3 || !(frequency * (whole.time.back() - whole.time.front()) >= fewest_swings))
    return {{}, {}, "swings fewer than six times: where it swings to cannot be told from the sensor's drift"};
  // A large offset of the sensor would cost digits.
  const double offset = median(whole.value);
  for (double& value : whole.value) value -= offset;
  TimeSeries place{whole.time, RunningIntegral(whole).at_rows()};
  const TimeSeries slow = moving_mean(moving_mean(place, period), period);
  TimeSeries swing{slow.time, {}};
  std::size_t row = 0;
  for (std::size_t i = 0; i < slow.time.size(); ++i) {
    while (place.time[row] < slow.time[i]) ++row;
    swing.value.push_back(place.value[row] - slow.value[i]);
  }
  if (swing.time.size() < 5) swing.why_not = "is too short: one period at either end tells no position";
  return swing;
}

}  // namespace shakedown
