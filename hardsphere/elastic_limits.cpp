// SPDX-License-Identifier: MIT
#include "elastic_limits.hpp"

#include <algorithm>
#include <cmath>

#include "falling_frame.hpp"

namespace shakedown {

namespace {

/// Diameters; how high grains hop at most on what they lie on. 0.005 to 0.04 give the same peaks within the
/// spread of runs.
constexpr double bed_hop = 0.025;

/// Restitutions below this stall rows between side walls. 0.5 does not, in 100 runs of 22 s; 0.3 of all walls
/// does, in a few runs.
constexpr double dead_restitution = 0.5;

/// Friction, attraction and accelerations press layers on walls that may themselves be at rest, where a
/// fraction of the box's speed is no limit at all; and clusters held together need a coarser one.
bool is_pressed(const Physics& physics, const FallingFrame& frame) {
  return physics.contact.has_friction() || physics.contact.has_attraction() ||
         physics.grains.arc_length != 0 || !frame.at_rest() || !physics.grains.free.empty() ||
         physics.box.dry_friction.sum() > 0 || !physics.box.dahl.empty();
}

}  // namespace

ElasticLimits pressed_by(double pull, ElasticLimits limits, double diameter) {
  limits.pull = pull;
  limits.wall_speed = std::max({limits.wall_speed, 1e-3, std::sqrt(2 * pull * bed_hop * diameter)});
  limits.pair_speed = std::max({limits.pair_speed, 1e-2, 2 * limits.wall_speed});
  return limits;
}

ElasticLimits elastic_limits(const Setup& setup, const Physics& physics) {
  ElasticLimits limits{setup.hard.wall_elastic_fraction, setup.hard.pair_elastic_speed,
                       setup.hard.wall_elastic_speed};
  const FallingFrame frame(physics.grains);
  // A layer at rest under an acceleration keeps the speeds at which its impacts become elastic. Five grains
  // of 10 mm fit a width of 50 mm exactly, so pressed rows have hardly any play, and the rate of impacts
  // goes as the square of the acceleration over the third power of that speed: with 1 mm/s some runs at 0.2
  // m/s^2 made 5 million impacts a second in a layer at rest. Hops of `bed_hop` keep it below a hundred
  // thousand.
  if (is_pressed(physics, frame))
    return pressed_by(std::hypot(frame.top(0), frame.top(1), frame.top(2)), limits, setup.grains.diameter);
  // Rows of unequal grains can be longer than the box is wide across: wedged between two side walls they lose
  // their last energy at once (one run in a few hundred). So do rows of equal ones where little of it comes
  // back (side walls of 0.1: one run in fifty).
  const std::array<double, contact_classes>& restitution = physics.contact.restitution;
  const bool dead = *std::min_element(restitution.begin(), restitution.end()) < dead_restitution;
  if (physics.relative_diameter_deviation > 0 || dead) limits.wall_speed = std::max(limits.wall_speed, 1e-3);
  if (dead) limits.pair_speed = std::max(limits.pair_speed, 1e-2);
  return limits;
}

}  // namespace shakedown
