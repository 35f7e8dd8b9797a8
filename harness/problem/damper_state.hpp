// SPDX-License-Identifier: MIT
// Where grains and box are, and how they move.
#pragma once
#include <vector>

#include "physics.hpp"

namespace shakedown {

/// Positions and velocities in the lab frame, box at x_box with velocity v_box (centre of the box along x; y
/// = z = 0 is its axis, also where the box follows an arc: then z and its velocity are as seen from the box).
struct State {
  std::vector<Vec3> position;  ///< m
  std::vector<Vec3> velocity;  ///< m/s
  std::vector<Vec3> spin;      ///< rad/s; empty: none
  std::vector<double> radius;  ///< m
  std::vector<double> mass;    ///< kg
  double x_box = 0;            ///< m
  double v_box = 0;            ///< m/s
  double pushed_apart = 0;     ///< m, the farthest that a measured position was moved out of an overlap
  std::size_t size() const { return position.size(); }  ///< number of grains
};

/// Returns the kinetic energy of the grains and of the box, J (translation and spin of solid spheres).
double kinetic_energy(const State& state, double box_mass);

/// Returns the mass-weighted mean of the grains' x, m; NaN without grains.
double centre_of_mass_x(const State& state);

}  // namespace shakedown
