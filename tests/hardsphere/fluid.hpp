// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <numbers>

#include "hard_sphere_system.hpp"

namespace shakedown {

/// Elastic spheres in a periodic cube at rest as a whole, molten from a lattice full of vacancies. Unit of
/// length: their diameter of 1 m; unit of mass: theirs, 1 kg; root mean square speed sqrt(3) m/s, so that k T
/// = 1 J up to the centre of mass's share.
inline Setup periodic_fluid(int grains, double packing_fraction) {
  Setup setup;
  setup.domain = Domain::periodic;
  setup.grains = {grains, 1.0, 1.0};
  setup.box.length = std::cbrt(grains * std::numbers::pi / 6 / packing_fraction);
  setup.box.width = {setup.box.length, setup.box.length};
  setup.restitution = {1.0, 1.0};
  setup.release.packing = Packing::random;
  setup.release.grain_speed = std::sqrt(3.0);
  return setup;
}

/// The same, molten: 20 impacts a grain, 5 of a system beyond 200 000 grains.
inline HardSphereSystem molten_fluid(int grains, double packing_fraction) {
  HardSphereSystem system(periodic_fluid(grains, packing_fraction));
  constexpr int large = 200'000;
  system.advance_impacts((grains > large ? 5LL : 20LL) * grains / 2);
  return system;
}

/// Kinetic temperature of N grains whose centre of mass is at rest, J.
inline double temperature(const State& state) {
  return 2 * kinetic_energy(state, 0) / (3 * (static_cast<double>(state.size()) - 1));
}

/// Collisions per grain and second over (Z - 1), in units of sqrt(k T / m) / diameter: exact for hard
/// spheres.
constexpr double rate_per_excess_pressure = 6 * std::numbers::inv_sqrtpi;

}  // namespace shakedown
