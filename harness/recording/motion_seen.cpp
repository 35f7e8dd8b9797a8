// SPDX-License-Identifier: MIT
#include "motion_seen.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr double least_swing = 0.1;      // of the whole range
constexpr double without_period = 0.2;   // s
constexpr std::size_t first_turns = 24;  // later ones are small, and noise decides when they are

/// Returns medians of three neighbouring frames, so that a single wrong frame is no turn.
std::vector<Turn> without_single_frames(const std::vector<double>& time, const std::vector<double>& x) {
  std::vector<Turn> kept;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i])) kept.push_back({time[i], x[i]});
  std::vector<Turn> smooth = kept;
  for (std::size_t i = 1; i + 1 < kept.size(); ++i) {
    const double a = kept[i - 1].position, b = kept[i].position, c = kept[i + 1].position;
    smooth[i].position = std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
  return smooth;
}

double range_of_turn(const std::vector<Turn>& frames) {
  std::vector<double> sorted;
  for (const Turn& frame : frames) sorted.push_back(frame.position);
  std::sort(sorted.begin(), sorted.end());
  const std::size_t wrong = sorted.size() / 500;  // at either end, a fifth of a percent
  return sorted.empty() ? 0 : sorted[sorted.size() - 1 - wrong] - sorted[wrong];
}

/// Returns the ends of the swings that exceed `least` (m): the farthest frame before the motion has come back
/// by that much.
std::vector<Turn> turns_of(const std::vector<Turn>& frames, double least) {
  std::vector<Turn> turns;
  if (frames.empty() || !(least > 0)) return turns;
  Turn lowest = frames.front(), highest = frames.front();
  int direction = 0;
  for (const Turn& frame : frames) {
    if (frame.position > highest.position) highest = frame;
    if (frame.position < lowest.position) lowest = frame;
    if (direction >= 0 && highest.position - frame.position > least) {
      if (direction > 0) turns.push_back(highest);
      direction = -1;
      lowest = frame;
    } else if (direction <= 0 && frame.position - lowest.position > least) {
      if (direction < 0) turns.push_back(lowest);
      direction = 1;
      highest = frame;
    }
    if (direction > 0 && frame.position >= highest.position) highest = frame;
    if (direction < 0 && frame.position <= lowest.position) lowest = frame;
  }
  return turns;
}

/// Returns twice the mean time between turns, s, of those that are near the usual one.
double period_of(const std::vector<Turn>& turns) {
  constexpr double near = 0.25;
  std::vector<double> halves;
  for (std::size_t i = 1; i < std::min(turns.size(), first_turns); ++i)
    halves.push_back(turns[i].time - turns[i - 1].time);
  if (halves.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double usual = median(halves);
  double sum = 0, count = 0;
  for (const double half : halves)
    if (std::abs(half / usual - 1) < near) sum += half, ++count;
  return 2 * (count > 0 ? sum / count : usual);
}

/// Returns the span of the values within `half` (s) to either side of each frame (by monotonic queues).
std::vector<double> excursions(const std::vector<double>& time, const std::vector<double>& x, double half) {
  std::vector<double> span(x.size(), std::numeric_limits<double>::quiet_NaN());
  std::deque<std::size_t> high, low;
  std::size_t next = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (; next < x.size() && time[next] <= time[i] + half; ++next) {
      if (!std::isfinite(x[next])) continue;
      while (!high.empty() && x[high.back()] <= x[next]) high.pop_back();
      while (!low.empty() && x[low.back()] >= x[next]) low.pop_back();
      high.push_back(next), low.push_back(next);
    }
    while (!high.empty() && time[high.front()] < time[i] - half) high.pop_front();
    while (!low.empty() && time[low.front()] < time[i] - half) low.pop_front();
    if (!high.empty() && !low.empty()) span[i] = x[high.front()] - x[low.front()];
  }
  return span;
}

}  // namespace

double MotionSeen::frames_per_period(double interval) const {
  return std::isfinite(period) && interval > 0 ? period / interval : std::numeric_limits<double>::infinity();
}

MotionSeen motion_seen(const std::vector<double>& time, const std::vector<double>& x) {
  const std::vector<Turn> frames = without_single_frames(time, x);
  MotionSeen seen;
  seen.range = range_of_turn(frames);
  seen.turns = turns_of(frames, least_swing * seen.range);
  seen.period = period_of(seen.turns);
  std::vector<double> smooth(x.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0, k = 0; i < x.size(); ++i)
    if (std::isfinite(x[i])) smooth[i] = frames[k++].position;
  seen.excursion = excursions(time, smooth, std::isfinite(seen.period) ? seen.period / 2 : without_period);
  return seen;
}

}  // namespace shakedown
