// SPDX-License-Identifier: MIT
#include "interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "expect.hpp"

namespace shakedown {

namespace {

/// The points of a monotone cubic, and what it rises by between and at them.
class Slopes {
 public:
  Slopes(std::span<const double> places, std::span<const double> values) : x_(places), y_(values) {}

  double width(std::size_t i) const { return x_[i + 1] - x_[i]; }
  double between(std::size_t i) const { return (y_[i + 1] - y_[i]) / width(i); }
  double at(std::size_t i) const {
    const std::size_t last = x_.size() - 1;
    if (last == 1) return between(0);
    if (i == 0) return at_end(width(0), width(1), between(0), between(1));
    if (i == last) return at_end(width(i - 1), width(i - 2), between(i - 1), between(i - 2));
    const double before = between(i - 1), after = between(i);
    if (!(before * after > 0)) return 0;
    const double w = 2 * width(i) + width(i - 1), v = width(i) + 2 * width(i - 1);
    return (w + v) / (w / before + v / after);
  }

 private:
  static double at_end(double near, double far, double slope, double next) {
    const double parabola = ((2 * near + far) * slope - near * next) / (near + far);
    if (!(parabola * slope > 0)) return 0;
    const bool turns = slope * next <= 0 && std::abs(parabola) > 3 * std::abs(slope);
    return turns ? 3 * slope : parabola;
  }

  std::span<const double> x_, y_;
};

}  // namespace

double interpolated(std::span<const double> places, std::span<const double> values, double x) {
  EXPECT(places.size() == values.size());
  if (places.empty() || !(x >= places.front() && x <= places.back()))
    return std::numeric_limits<double>::quiet_NaN();
  const auto after = std::upper_bound(places.begin(), places.end(), x);
  if (after == places.end()) return values.back();
  const auto i = static_cast<std::size_t>(after - places.begin()) - 1;
  return values[i] + (values[i + 1] - values[i]) * (x - places[i]) / (places[i + 1] - places[i]);
}

double monotone_cubic(std::span<const double> places, std::span<const double> values, double x) {
  EXPECT(places.size() == values.size() && places.size() >= 2);
  if (std::isnan(x)) return x;
  if (!(x > places.front())) return values.front();
  if (!(x < places.back())) return values.back();
  const auto after = std::upper_bound(places.begin(), places.end(), x);
  const auto i = static_cast<std::size_t>(after - places.begin()) - 1;
  const Slopes slopes(places, values);
  const double width = slopes.width(i), at = x - places[i], chord = slopes.between(i);
  const double left = slopes.at(i), right = slopes.at(i + 1);
  const double square = (3 * chord - 2 * left - right) / width,
               cube = (left + right - 2 * chord) / (width * width);
  return values[i] + at * (left + at * (square + at * cube));
}

}  // namespace shakedown
