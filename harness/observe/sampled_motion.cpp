// SPDX-License-Identifier: MIT
#include "sampled_motion.hpp"

#include <cmath>

#include "errors.hpp"

namespace shakedown {

namespace {

/// Returns the slope at sample i of the parabola through it and its neighbours (at the ends: through the
/// three nearest), m/s.
double parabola_slope(const SampledMotion& motion, std::size_t i) {
  const std::size_t last = motion.size() - 1;
  const auto secant = [&](std::size_t k) {
    return (motion.position[k + 1] - motion.position[k]) / (motion.time[k + 1] - motion.time[k]);
  };
  if (last < 2) return secant(0);
  const std::size_t k = i == 0 ? 0 : (i == last ? last - 2 : i - 1);
  const double left = secant(k), right = secant(k + 1);
  const double bend = (right - left) / (motion.time[k + 2] - motion.time[k]);
  return left + bend * (2 * motion.time[i] - motion.time[k] - motion.time[k + 1]);
}

}  // namespace

CubicPiece piece_of(const SampledMotion& motion, std::size_t i) {
  EXPECT(i + 1 < motion.size());
  const double length = motion.time[i + 1] - motion.time[i];
  const bool measured = !motion.velocity.empty();
  const double rise_left = length * (measured ? motion.velocity[i] : parabola_slope(motion, i));
  const double rise_right = length * (measured ? motion.velocity[i + 1] : parabola_slope(motion, i + 1));
  const double rise = motion.position[i + 1] - motion.position[i];
  return {motion.time[i],
          length,
          motion.position[i],
          rise_left,
          3 * rise - 2 * rise_left - rise_right,
          rise_left + rise_right - 2 * rise};
}

std::vector<double> stationary_places(const CubicPiece& piece) {
  // c1 + 2 c2 u + 3 c3 u^2 = 0 without cancellation.
  std::vector<double> places;
  const double discriminant = piece.c2 * piece.c2 - 3 * piece.c1 * piece.c3;
  if (discriminant < 0) return places;
  const double q = -(piece.c2 + std::copysign(std::sqrt(discriminant), piece.c2));
  for (const double u : {q / (3 * piece.c3), piece.c1 / q})
    if (u > 0 && u < 1) places.push_back(u);  // also drops the infinities and NaN of vanishing coefficients
  return places;
}

double zero_place(const CubicPiece& piece) {
  double low = 0, high = 1;
  const bool rising = piece.at(0) < 0;
  for (int halving = 0; halving < 53; ++halving) {
    const double middle = (low + high) / 2;
    ((piece.at(middle) < 0) == rising ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace shakedown
