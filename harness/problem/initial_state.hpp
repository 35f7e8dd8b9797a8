// SPDX-License-Identifier: MIT
// One initial state for all engines.
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
  std::size_t size() const { return position.size(); }
};

/// The state at release of run number `run` (>= 0): random numbers are addressed by (seed, run, stream), so
/// any run can be made alone. Throws InputError when the grains do not fit, overlap or leave the box;
/// FileError when the grain file cannot be read.
State initial_state(const Setup& setup, int run = 0);

/// Kinetic energy of the grains and of the box, J (translation and spin of solid spheres).
double kinetic_energy(const State& state, double box_mass);

/// Mass-weighted mean of the grains' x, m; NaN without grains.
double centre_of_mass_x(const State& state);

}  // namespace shakedown
