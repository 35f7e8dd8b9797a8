// SPDX-License-Identifier: MIT
#include "integrated_motion.hpp"

#include <algorithm>
#include <cmath>

#include "robust_statistics.hpp"

namespace shakedown {

namespace {

/// Of a piecewise linear series: its integral from the first time on, at any time.
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
  /// At each time of the series.
  const std::vector<double>& at_rows() const { return sum_; }

 private:
  const TimeSeries& series_;
  std::vector<double> sum_;
};

/// Mean over `width` (s) about each time that has as much on either side.
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

/// Median time between upward passages through the middle, s; 0 where there are fewer than six of them. A
/// passage counts once the series has been a third of its deviation below.
double period_of(const TimeSeries& series) {
  double sum = 0, squares = 0;
  for (const double value : series.value) sum += value;
  const double middle = sum / static_cast<double>(series.value.size());
  for (const double value : series.value) squares += (value - middle) * (value - middle);
  const double below = std::sqrt(squares / static_cast<double>(series.value.size())) / 3;
  std::vector<double> passages;
  bool armed = false;
  for (std::size_t i = 1; i < series.value.size(); ++i) {
    const double before = series.value[i - 1] - middle, now = series.value[i] - middle;
    armed = armed || now < -below;
    if (!armed || !(before < 0 && now >= 0)) continue;
    passages.push_back(series.time[i - 1] + (series.time[i] - series.time[i - 1]) * before / (before - now));
    armed = false;
  }
  constexpr std::size_t fewest = 6;
  if (passages.size() < fewest) return 0;
  std::vector<double> apart;
  for (std::size_t i = 1; i < passages.size(); ++i) apart.push_back(passages[i] - passages[i - 1]);
  return median(apart);
}

}  // namespace

TimeSeries integral_of_swing(const TimeSeries& rate) {
  TimeSeries whole;
  for (std::size_t i = 0; i < rate.time.size(); ++i)
    if (std::isfinite(rate.value[i]))
      whole.time.push_back(rate.time[i]), whole.value.push_back(rate.value[i]);
  const double period = whole.time.size() < 3 ? 0 : period_of(whole);
  if (!(period > 0))
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
