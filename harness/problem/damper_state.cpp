// SPDX-License-Identifier: MIT
#include "damper_state.hpp"

#include <limits>

namespace shakedown {

double kinetic_energy(const State& state, double box_mass) {
  double energy = box_mass * state.v_box * state.v_box / 2;
  for (std::size_t i = 0; i < state.velocity.size(); ++i) {
    energy += state.mass[i] * state.velocity[i].squaredNorm() / 2;
    if (!state.spin.empty())
      energy += 0.2 * state.mass[i] * state.radius[i] * state.radius[i] * state.spin[i].squaredNorm();
  }
  return energy;
}

double centre_of_mass_x(const State& state) {
  if (state.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  double moment = 0, mass = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    moment += state.mass[i] * state.position[i].x();
    mass += state.mass[i];
  }
  return moment / mass;
}

}  // namespace shakedown
