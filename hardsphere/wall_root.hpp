// SPDX-License-Identifier: MIT
// When a grain in free flight meets an end wall of a box that swings on a spring.
//
// The gap of a grain to the wall, counted positive inside the box, is
//   g(t) = a cos Wt + b sin Wt + c - u t
// with a, b from the box's state, c the room, u the grain's speed towards the wall. Its stationary points are
// known in closed form, sin(Wt - phi) = -u / (W R), R = hypot(a, b): g is monotone between them, so the first
// root is bracketed with certainty. No root can be missed, and the root at t = 0 of a grain that has just
// left the wall is excluded by construction.
#pragma once
#include <cmath>
#include <limits>

namespace shakedown {

constexpr double never = std::numeric_limits<double>::infinity();

struct HarmonicGap {
  double a, b;               ///< m
  double angular_frequency;  ///< rad/s, > 0
  double c;                  ///< m
  double u;                  ///< m/s

  struct Value {
    double gap, rate;
  };
  /// Returns the gap, m, and its rate of change, m/s, at time t, s.
  Value value(double t) const {
    const double phase = angular_frequency * t, cosine = std::cos(phase), sine = std::sin(phase);
    return {a * cosine + b * sine + c - u * t, angular_frequency * (b * cosine - a * sine) - u};
  }
};

/// Returns the earliest time t >= 0, s, at which the gap closes from above; `never` when it does not (within
/// 1e12 periods). A gap that is zero (or below by rounding) and closing gives 0; one that is opening is
/// followed to its next maximum first. Error: a few units in the last place of t.
double first_wall_root(const HarmonicGap& gap);

/// Returns a time, s from now, before which no root can lie whatever the phase: g(t) >= g + g' t - A t^2 / 2
/// with |g''| <= A. For A = 0 it is the root.
inline double earliest_possible_root(double gap, double rate, double top_acceleration) {
  const double room = gap > 0 ? gap : 0;
  if (top_acceleration <= 0) return rate < 0 ? room / -rate : never;
  const double root = std::sqrt(rate * rate + 2 * top_acceleration * room);
  // Two forms of the same root, each without cancellation; which one is as good as random, so both numbers
  // are chosen without a branch.
  const double above = rate >= 0 ? rate + root : 2 * room, below = rate >= 0 ? top_acceleration : root - rate;
  return above / below;
}

}  // namespace shakedown
