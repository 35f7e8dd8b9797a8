// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "end_walls.hpp"

namespace shakedown {

/// A grain in straight flight: place (m) and velocity (m/s) at its own `time` (s).
struct Flight3 {
  std::array<double, 3> x, v;
  double time;
  /// Returns the coordinate at time t, m.
  double along(int axis, double t) const {
    return x[static_cast<std::size_t>(axis)] + v[static_cast<std::size_t>(axis)] * (t - time);
  }
  /// Describes the same flight from time t on.
  void advance(double t) {
    for (std::size_t axis = 0; axis < 3; ++axis) x[axis] += v[axis] * (t - time);
    time = t;
  }
};

/// Sums over all grains: mass, kg; kinetic energy, J; first moment of x at a time, kg m; momentum, kg m/s.
struct GrainSums {
  double mass = 0, kinetic = 0, moment = 0;
  std::array<double, 3> momentum{};
};

/// Partners that are not grains.
constexpr std::int32_t no_partner = -1;
constexpr std::int32_t leaves_neighbourhood = -2;
constexpr std::int32_t side_wall_y_low = -3;  ///< then y high, z low, z high: -4, -5, -6
constexpr bool is_side_wall(std::int32_t partner) { return partner <= side_wall_y_low; }
constexpr int side_wall_axis(std::int32_t partner) { return 1 + (side_wall_y_low - partner) / 2; }
constexpr int side_wall_sign(std::int32_t partner) { return (side_wall_y_low - partner) % 2 == 0 ? -1 : 1; }
constexpr std::int32_t side_wall(int axis, int sign) {
  return side_wall_y_low - 2 * (axis - 1) - (sign > 0 ? 1 : 0);
}

/// The earliest thing that will happen to a grain besides an end wall.
struct GrainEvent {
  double time = never;
  std::int32_t partner = no_partner;
  std::uint32_t partner_count =
      0;  ///< impacts of the partner when this was predicted; it is stale once that has changed
  Meeting meeting = Meeting::touch;
};

/// Returns the time until two spheres touch, s: separation r, relative velocity w; b = r.w, c = r^2 -
/// reach^2, a = w^2. Both forms of the quadratic's root that cancel are avoided; spheres that touch (or
/// overlap by rounding) and approach collide at once, separating ones never.
inline double time_to_touch(double a, double b, double c) {
  if (b >= 0) return never;
  if (c <= 0) return 0;
  const double discriminant = b * b - a * c;
  return discriminant < 0 ? never : c / (std::sqrt(discriminant) - b);
}

/// Returns the earliest meeting with one of the four fixed side walls, which leave the centre `room` (m) to
/// either side. Which way a grain flies is as good as random, so no branch is taken on it.
inline GrainEvent next_side_wall(const Flight3& flight, const std::array<double, 2>& room) {
  std::array<double, 2> time;
  for (std::size_t k = 0; k < 2; ++k) {
    const double v = flight.v[k + 1], gap = room[k] - std::copysign(1.0, v) * flight.x[k + 1];
    time[k] = v == 0 ? never : flight.time + std::max(gap, 0.0) / std::abs(v);
  }
  const int axis = time[1] < time[0] ? 2 : 1;
  const double earliest = std::min(time[0], time[1]);
  return {
      earliest,
      earliest < never ? side_wall(axis, flight.v[static_cast<std::size_t>(axis)] > 0 ? 1 : -1) : no_partner,
      0, Meeting::touch};
}

}  // namespace shakedown
