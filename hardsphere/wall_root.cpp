// SPDX-License-Identifier: MIT
#include "wall_root.hpp"

#include <algorithm>
#include <numbers>

namespace shakedown {

namespace {

/// Returns the root of a gap that falls monotonically from above zero at `low` to zero or below at `high`, by
/// Newton's method kept in the bracket.
double root_in(const HarmonicGap& gap, double low, double high) {
  double t = low + (high - low) / 2;
  // From the low end the curvature bound gives a start that cannot overshoot.
  const double curvature = std::hypot(gap.a, gap.b) * gap.angular_frequency * gap.angular_frequency;
  const HarmonicGap::Value start =
      low == 0 ? HarmonicGap::Value{gap.a + gap.c, gap.angular_frequency * gap.b - gap.u} : gap.value(low);
  if (curvature > 0) t = std::min(t, low + earliest_possible_root(start.gap, start.rate, curvature));
  // Below this a gap is rounding: half a unit in the last place of the largest term.
  const double noise = 0x1p-53 * (std::abs(gap.a) + std::abs(gap.b) + std::abs(gap.c));
  for (int iteration = 0; iteration < 200; ++iteration) {
    const HarmonicGap::Value now = gap.value(t);
    const double value = now.gap, slope = now.rate;
    if (std::abs(value) <= noise) break;
    if (value > 0)
      low = t;
    else
      high = t;
    double next = slope < 0 ? t - value / slope : low + (high - low) / 2;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    const double step = std::abs(next - t);
    t = next;
    if (step <= 2e-16 * t || high - low <= 2e-16 * high) break;
  }
  return t;
}

/// The falling stretch, as phases, in which the first root lies when there is one: from a maximum (or the
/// start) to a minimum.
struct FallingStretch {
  double maximum, minimum;
};

FallingStretch next_falling_stretch(const HarmonicGap& gap, double amplitude, double start_rate) {
  constexpr double pi = std::numbers::pi, turn = 2 * pi;
  const double phi = std::atan2(gap.b, gap.a), tilt = std::asin(-gap.u / (gap.angular_frequency * amplitude));
  const double length = pi - 2 * tilt;
  double minimum = std::fmod(phi + pi - tilt, turn);
  if (minimum <= 0) minimum += turn;
  // An opening gap with a minimum just ahead is past that minimum but for rounding: its stretch is the next
  // one.
  if (start_rate >= 0 && minimum < length / 2) minimum += turn;
  return {minimum - length, minimum};
}

/// Returns the root just ahead of a gap that closes; negative when none is seen at once. With |g'''| <= J the
/// gap within a horizon H stays above g + g' t + (g'' - J H / 3) t^2 / 2: the root of that is never late, and
/// third-order steps of the kind arrive after one or two sines. Most roots are of this kind, as they are
/// sought from a bound shortly before, so that this saves 5 to 10 % of a damper's time.
double root_ahead(const HarmonicGap& gap) {
  constexpr double none = -1;
  const double w = gap.angular_frequency, jerk = w * w * w * (std::abs(gap.a) + std::abs(gap.b));
  const double noise = 0x1p-54 * (std::abs(gap.a) + std::abs(gap.b) + std::abs(gap.c));
  double t = 0, here = gap.a + gap.c, rate = w * gap.b - gap.u, swing = gap.a;
  for (int step = 0; step < 5; ++step) {
    if (!(rate < 0)) return none;
    if (here <= noise) return t;
    const double horizon = -2 * here / rate, curvature = jerk * horizon / 3 + w * w * swing;
    const double squared = rate * rate + 2 * curvature * here;
    // too far to be sure of, or hardly a crossing
    if (!(w * horizon < 1 && 4 * squared > rate * rate)) return none;
    const double wait = 2 * here / (std::sqrt(squared) - rate);
    if (wait > horizon) return none;
    t += wait;
    if (jerk * horizon * wait * wait / 3 <= noise) return t;
    const double cosine = std::cos(w * t), sine = std::sin(w * t);
    swing = gap.a * cosine + gap.b * sine;
    here = swing + gap.c - gap.u * t;
    rate = w * (gap.b * cosine - gap.a * sine) - gap.u;
  }
  return none;
}

}  // namespace

double first_wall_root(const HarmonicGap& gap) {
  constexpr double turn = 2 * std::numbers::pi;
  const double w = gap.angular_frequency, start = gap.a + gap.c, start_rate = w * gap.b - gap.u;
  if (start <= 0 && start_rate < 0) return 0;
  if (const double ahead = root_ahead(gap); ahead >= 0) return ahead;
  const double amplitude = std::hypot(gap.a, gap.b);
  // the grain outruns the wall: the gap is monotone
  if (amplitude * w <= std::abs(gap.u) || amplitude == 0) {
    if (gap.u <= 0) return never;
    return root_in(gap, 0, std::max(amplitude + gap.c, 0.0) / gap.u * (1 + 1e-15) + 1e-300);
  }
  FallingStretch stretch = next_falling_stretch(gap, amplitude, start_rate);
  const double lowest = gap.value(stretch.minimum / w).gap;
  if (lowest > 0) {
    if (gap.u <= 0) return never;  // later minima are no lower
    const double periods = std::ceil(lowest / (gap.u * turn / w));
    if (!(periods < 1e12)) return never;
    const auto later = [&](double n) {
      return FallingStretch{stretch.maximum + n * turn, stretch.minimum + n * turn};
    };
    FallingStretch found = later(periods);
    if (gap.value(found.minimum / w).gap > 0) found = later(periods + 1);  // the division rounded down
    stretch = found;
  }
  return root_in(gap, std::max(0.0, stretch.maximum / w), stretch.minimum / w);
}

}  // namespace shakedown
