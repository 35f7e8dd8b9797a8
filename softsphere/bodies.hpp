// SPDX-License-Identifier: MIT
// Grains and box of a soft run as a structure of arrays: rows 0 .. N-1 are grains, row N is the box.
#pragma once
#include "damper_state.hpp"

namespace shakedown {

struct Bodies {
  using Rows = Eigen::Array<double, Eigen::Dynamic, 3>;  // column by column: each coordinate is contiguous
  using Column = Eigen::ArrayXd;

  Eigen::Index grains = 0;
  Rows position;               ///< m; x in the lab, y and z from the box's axis
  Rows velocity;               ///< m/s
  Rows spin;                   ///< rad/s
  Column radius, mass;         ///< of the grains
  Column inverse_mass;         ///< along x, box included; 0 for a box that is held
  Column inverse_mass_across;  ///< along y and z: the box is guided, 0
  Column inverse_inertia;      ///< solid spheres, 5/(2 m R^2); 0 for the box

  Eigen::Index box() const { return grains; }  ///< row of the box
  /// Return place and velocity of the box along x, m and m/s.
  double& x_box() { return position(grains, 0); }
  double& v_box() { return velocity(grains, 0); }
  double x_box() const { return position(grains, 0); }
  double v_box() const { return velocity(grains, 0); }
  /// Return place (m), velocity (m/s) and spin (rad/s) of the body in this row, the box included.
  Vec3 position_of(Eigen::Index body) const { return position.row(body).matrix(); }
  Vec3 velocity_of(Eigen::Index body) const { return velocity.row(body).matrix(); }
  Vec3 spin_of(Eigen::Index body) const { return spin.row(body).matrix(); }
};

/// Returns the state as arrays; `box_mass`: kg, 0 for a box that is held still.
inline Bodies bodies_of(const State& state, double box_mass) {
  Bodies bodies;
  const auto n = static_cast<Eigen::Index>(state.size());
  bodies.grains = n;
  bodies.position.setZero(n + 1, 3);
  bodies.velocity.setZero(n + 1, 3);
  bodies.spin.setZero(n + 1, 3);
  bodies.radius.resize(n);
  bodies.mass.resize(n);
  bodies.inverse_mass.setZero(n + 1);
  bodies.inverse_mass_across.setZero(n + 1);
  bodies.inverse_inertia.setZero(n + 1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto s = static_cast<std::size_t>(i);
    bodies.position.row(i) = state.position[s].transpose().array();
    bodies.velocity.row(i) = state.velocity[s].transpose().array();
    if (!state.spin.empty()) bodies.spin.row(i) = state.spin[s].transpose().array();
    bodies.radius(i) = state.radius[s];
    bodies.mass(i) = state.mass[s];
    bodies.inverse_mass(i) = bodies.inverse_mass_across(i) = 1 / state.mass[s];
    bodies.inverse_inertia(i) = 2.5 / (state.mass[s] * state.radius[s] * state.radius[s]);
  }
  bodies.x_box() = state.x_box;
  bodies.v_box() = state.v_box;
  bodies.inverse_mass(n) = box_mass > 0 ? 1 / box_mass : 0;
  return bodies;
}

/// Returns the arrays as a state.
inline State state_of(const Bodies& bodies) {
  State state;
  for (Eigen::Index i = 0; i < bodies.grains; ++i) {
    state.position.push_back(bodies.position_of(i));
    state.velocity.push_back(bodies.velocity_of(i));
    state.spin.push_back(bodies.spin_of(i));
    state.radius.push_back(bodies.radius(i));
    state.mass.push_back(bodies.mass(i));
  }
  state.x_box = bodies.x_box();
  state.v_box = bodies.v_box();
  return state;
}

}  // namespace shakedown
