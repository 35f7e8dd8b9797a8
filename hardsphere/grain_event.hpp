// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstdint>

#include "end_walls.hpp"

namespace shakedown {

/// A grain in straight flight: where it is at its own `time`.
struct Flight3 {
  std::array<double, 3> x, v;
  double time;
  double along(int axis, double t) const {
    return x[static_cast<std::size_t>(axis)] + v[static_cast<std::size_t>(axis)] * (t - time);
  }
  void advance(double t) {
    for (std::size_t axis = 0; axis < 3; ++axis) x[axis] += v[axis] * (t - time);
    time = t;
  }
};

/// Sums over all grains: mass, kinetic energy, first moment of x at a time, momentum.
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
constexpr std::int32_t side_wall(int axis, int sign) { return side_wall_y_low - 2 * (axis - 1) - (sign > 0 ? 1 : 0); }

/// The earliest thing that will happen to a grain besides an end wall.
struct GrainEvent {
  double time = never;
  std::int32_t partner = no_partner;
  std::uint32_t partner_count = 0;  ///< impacts of the partner when this was predicted; it is stale once that has changed
  Meeting meeting = Meeting::touch;
};

/// Time until two spheres touch: separation r, relative velocity w; b = r.w, c = r^2 - reach^2, a = w^2. Both forms of the quadratic's
/// root that cancel are avoided; spheres that touch (or overlap by rounding) and approach collide at once, separating ones never.
inline double time_to_touch(double a, double b, double c) {
  if (b >= 0) return never;
  if (c <= 0) return 0;
  const double discriminant = b * b - a * c;
  return discriminant < 0 ? never : c / (std::sqrt(discriminant) - b);
}

/// Earliest of the four fixed side walls at +-room about the axis.
inline GrainEvent next_side_wall(const Flight3& flight, const std::array<double, 2>& room) {
  GrainEvent next;
  for (int axis = 1; axis <= 2; ++axis) {
    const std::size_t k = static_cast<std::size_t>(axis);
    const double v = flight.v[k];
    if (v == 0) continue;
    const int sign = v > 0 ? 1 : -1;
    const double gap = room[k - 1] - sign * flight.x[k];
    const double time = flight.time + (gap > 0 ? gap / std::abs(v) : 0.0);
    if (time < next.time) next = {time, side_wall(axis, sign), 0, Meeting::touch};
  }
  return next;
}

}  // namespace shakedown
