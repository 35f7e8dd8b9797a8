// SPDX-License-Identifier: MIT
#include "physics.hpp"

#include <cmath>
#include <numbers>

namespace shakedown {

bool BoxForces::none() const {
  return viscous.sum() == 0 && dry_friction.sum() == 0 && constant.sum() == 0 && harmonics.empty() &&
         free.empty() && dahl.empty();
}

double BoxForces::newton(double x, double v, double t, double spring) const {
  double force = spring - viscous.sum() * v + constant.sum();
  for (const Harmonic& harmonic : harmonics) force += harmonic.at(t);
  for (const FreeForce& one : free) force += one.newton(x, v, t);
  return force;
}

bool GrainForces::none() const {
  return constant.sum().isZero(0) && harmonics.empty() && drag.sum().none() && free.empty() &&
         arc_length == 0;
}

Physics physics_of(const Setup& setup) {
  Physics physics;
  const double angular_frequency = 2 * std::numbers::pi * setup.spring.frequency;
  physics.box_mass = setup.box.mass;
  physics.stiffness =
      setup.domain == Domain::damper ? setup.box.mass * angular_frequency * angular_frequency : 0.0;
  physics.packing = setup.release.packing;
  physics.release_displacement = setup.release.displacement;
  physics.soft_contact_time = setup.soft.contact_time;
  const double wall = setup.restitution.grain_wall;
  physics.contact.restitution = {setup.restitution.grain_grain, wall, wall};
  for (const bool last : {false, true})
    for (std::size_t i = 0; i < setup.effects.size(); ++i)
      if (setup.effects[i].record->applied_last == last)
        setup.effects[i].record->apply(setup.effects[i], static_cast<int>(i), physics);
  return physics;
}

}  // namespace shakedown
