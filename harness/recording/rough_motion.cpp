// SPDX-License-Identifier: MIT
#include "rough_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "local_polynomial.hpp"
#include "nothing.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

struct Point {
  double time, x;
};

std::vector<Point> points_of(const std::vector<double>& time, const std::vector<double>& x) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < time.size() && i < x.size(); ++i)
    if (std::isfinite(x[i])) points.push_back({time[i], x[i]});
  return points;
}

double interval_of(const std::vector<Point>& points) {
  std::vector<double> time;
  for (const Point& point : points) time.push_back(point.time);
  return typical_interval(time);
}

/// Returns the distance between the 1 % and 99 % quantiles, which a few wrong frames do not move, m.
double range_of_points(const std::vector<Point>& points) {
  std::vector<double> values;
  for (const Point& point : points) values.push_back(point.x);
  std::sort(values.begin(), values.end());
  return values[values.size() * 99 / 100] - values[values.size() / 100];
}

/// Returns the points at which the motion turns back by more than `least`, m.
std::vector<Point> turning_points(const std::vector<Point>& points, double least) {
  std::vector<Point> turns;
  Point high = points.front(), low = points.front();
  int direction = 0;
  for (const Point& point : points) {
    if (point.x > high.x) high = point;
    if (point.x < low.x) low = point;
    if (direction >= 0 && point.x < high.x - least) {
      turns.push_back(high);
      direction = -1, low = point;
    } else if (direction <= 0 && point.x > low.x + least) {
      turns.push_back(low);
      direction = 1, high = point;
    }
  }
  return turns;
}

void set_swing(const std::vector<Point>& turns, RoughMotion& motion) {
  if (turns.size() < 3) return;
  motion.amplitude = std::abs(turns[1].x - turns[0].x) / 2;
  // A rest before the release would stretch the first half swing.
  const std::size_t from = turns.size() > 3 ? 1 : 0;
  motion.frequency =
      static_cast<double>(turns.size() - 1 - from) / (2 * (turns.back().time - turns[from].time));
  motion.first_frequency = 1 / (turns[from + 2].time - turns[from].time);
  std::vector<double> centres;  // a decay that is linear in time drops out
  for (std::size_t i = 1; i + 1 < turns.size(); ++i)
    centres.push_back((turns[i - 1].x + 2 * turns[i].x + turns[i + 1].x) / 4);
  motion.centre = median(centres);
  motion.centre_error =
      std::max(robust_deviation(centres), motion.noise) / std::sqrt(static_cast<double>(centres.size()));
}

double noise_of_points(const std::vector<Point>& points) {
  std::vector<double> differences;  // of second order: 0 for steady motion
  for (std::size_t i = 2; i < points.size(); ++i)
    differences.push_back(points[i].x - 2 * points[i - 1].x + points[i - 2].x);
  return differences.empty() ? nothing : robust_deviation(differences) / std::sqrt(6.0);
}

/// Prefers the frequency of the whole run, which is better known, unless the first swing has another.
double frequency_at_start(const RoughMotion& motion) {
  constexpr double another = 1.5;  // times: grains that come along change it by less
  const double ratio = motion.first_frequency / motion.frequency;
  return ratio > another || ratio < 1 / another ? motion.first_frequency : motion.frequency;
}

/// Finds the speed of the first frame from a least-squares x = a + b t + c t^2 over the first twelfth of a
/// swing.
void set_delay(const std::vector<Point>& points, RoughMotion& motion) {
  const double omega = 2 * std::numbers::pi * frequency_at_start(motion);
  const double begin = points.front().time;
  LocalPolynomial<3> parabola;
  for (const Point& point : points) {
    const double t = omega * (point.time - begin);  // rad
    if (t > std::numbers::pi / 6) break;
    parabola.add(t, point.x - motion.centre);
  }
  constexpr int enough = 6;
  if (parabola.count() < enough) return;
  const Eigen::Vector3d fit = parabola.coefficients();
  motion.start_delay = std::atan2(-fit[1], fit[0]) / omega;
  motion.delay_error = motion.noise * std::sqrt(parabola.covariance()(1, 1)) / (std::abs(fit[0]) * omega);
}

/// Returns the time until the position has left the mean of the frames before by five standard deviations,
/// less the time that a swing from rest takes for that, s.
double lead_in_of(const std::vector<Point>& points, double interval, const RoughMotion& motion) {
  constexpr double frames_needed = 50;  // a period: with fewer the first ones differ by motion, not by noise
  const double frequency = frequency_at_start(motion);
  if (frequency * interval * frames_needed > 1) return 0;
  const double omega = 2 * std::numbers::pi * frequency;
  const double left = 5 * std::max(motion.noise, 1e-3 * motion.amplitude);
  double sum = 0;
  std::size_t count = 0;
  for (const Point& point : points) {
    if (count > 3 && std::abs(point.x - sum / static_cast<double>(count)) > left) {
      const double taken = std::sqrt(2 * left / motion.amplitude) / omega;
      return std::max(0.0, point.time - points.front().time - taken);
    }
    sum += point.x;
    ++count;
  }
  return 0;
}

double unbroken_share(const std::vector<Point>& points, double interval) {
  constexpr std::size_t long_enough = 5;
  std::size_t inside = 0, stretch = 1;
  const auto close = [&] {
    if (stretch >= long_enough) inside += stretch;
    stretch = 1;
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double apart = (points[i].time - points[i - 1].time) / interval;
    if (apart > 0.5 && apart < 1.5)
      ++stretch;
    else
      close();
  }
  close();
  const double expected = (points.back().time - points.front().time) / interval + 1;
  return static_cast<double>(inside) / expected;
}

}  // namespace

RoughMotion rough_motion(const std::vector<double>& time, const std::vector<double>& x) {
  RoughMotion motion{nothing, nothing, nothing, nothing, nothing, nothing, 0, nothing, nothing, 0, nothing};
  const std::vector<Point> points = points_of(time, x);
  if (points.size() < 5) return motion;
  const double interval = interval_of(points);
  motion.unbroken = unbroken_share(points, interval);
  motion.noise = noise_of_points(points);
  motion.first = (points[0].x + points[1].x + points[2].x) / 3;
  constexpr double least_turn = 0.2;  // of the whole range: above noise, below the first swings
  const double range = range_of_points(points);
  if (!(range > 0)) return motion;
  set_swing(turning_points(points, least_turn * range), motion);
  if (!std::isfinite(motion.frequency)) return motion;
  motion.lead_in = lead_in_of(points, interval, motion);
  set_delay(points, motion);
  return motion;
}

double distance_from_sine(const std::vector<double>& time, const std::vector<double>& x, double frequency,
                          double centre) {
  const std::vector<Point> points = points_of(time, x);
  if (points.size() < 5 || !std::isfinite(frequency)) return nothing;
  const double sixth = 1 / (6 * frequency);
  const auto shift = static_cast<std::size_t>(std::lround(sixth / interval_of(points)));
  if (shift < 2) return nothing;
  double residual = 0, square = 0;
  for (std::size_t i = shift; i + shift < points.size(); ++i) {
    const double span = points[i + shift].time - points[i - shift].time;
    if (std::abs(span / (2 * sixth) - 1) > 0.1) continue;  // frames are missing between
    const double here = points[i].x - centre;
    const double off = points[i - shift].x + points[i + shift].x - 2 * centre - here;
    residual += off * off;
    square += here * here;
  }
  return square > 0 ? std::sqrt(residual / square) : nothing;
}

}  // namespace shakedown
