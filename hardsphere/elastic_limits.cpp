// SPDX-License-Identifier: MIT
#include "elastic_limits.hpp"

#include <algorithm>
#include <cmath>

#include "falling_frame.hpp"
#include "held_bonds.hpp"

namespace shakedown {

namespace {

/// A layer at rest rattles: the shorter its free paths, the slower and the more often. They end where grains
/// would be in contact all the time, at the hairbreadth of attracting grains up to 1 m/s^2 and in proportion
/// above, which keeps the time between impacts the same (some 0.4 ms; longer contacts than those of the soft
/// engine by default). Films of soft contacts under 0.1 g along the motion leave the misfit of the model's
/// own runs 1.07 times, with twice the path 1.18 times. Under 1 g runs cost a tenth as with 2 um, and lose
/// the same to 1 %.
constexpr double path_per_acceleration = HeldBonds::hairbreadth / 1.0;  // m of path for m/s^2
constexpr double widest_path = 2e-3;                                    // diameters

/// Restitutions below this stall rows between side walls. 0.5 does not, in 100 runs of 22 s; 0.3 of all walls
/// does, in a few runs.
constexpr double dead_restitution = 0.5;

/// Rows of grains through a thick layer lose their last energy at once where little comes back: for so much
/// of layers times (1 - restitution) it takes thresholds as those below a restitution of 0.5 in the paper's
/// damper of 1.5 layers (in one dimension a row of n collapses where n (1 - restitution) is above some pi/2:
/// S. McNamara and W. R. Young, Phys. Fluids A 4, 496, 1992). Of 75 grains in the paper's cross-section, a
/// box of 10 m/s^2, two runs in 80 ended with a restitution of 0.632 (1.1), none of 60 with 0.75 (0.75).
constexpr double collapsing_depth = 0.74;

double depth_of_layers(const Setup& setup, double restitution) {
  const double diameter = setup.grains.diameter;
  return setup.grains.count * diameter * diameter / (setup.box.width[0] * setup.box.width[1]) *
         (1 - restitution);
}

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
  limits.wall_speed = std::max(limits.wall_speed, 1e-3);
  limits.pair_speed = std::max(limits.pair_speed, 1e-2);
  if (pull > 0)
    limits.free_path =
        std::min(std::max(HeldBonds::hairbreadth, path_per_acceleration * pull), widest_path * diameter);
  return limits;
}

ElasticLimits elastic_limits(const Setup& setup, const Physics& physics) {
  ElasticLimits limits{setup.hard.wall_elastic_fraction, setup.hard.pair_elastic_speed,
                       setup.hard.wall_elastic_speed};
  const FallingFrame frame(physics.grains);
  if (is_pressed(physics, frame))
    return pressed_by(std::hypot(frame.top(0), frame.top(1), frame.top(2)), limits, setup.grains.diameter);
  // Rows of unequal grains can be longer than the box is wide across: wedged between two side walls they lose
  // their last energy at once (one run in a few hundred). So do rows of equal ones where little of it comes
  // back (side walls of 0.1: one run in fifty).
  const std::array<double, contact_classes>& restitution = physics.contact.restitution;
  const bool dead = *std::min_element(restitution.begin(), restitution.end()) < dead_restitution;
  if (physics.relative_diameter_deviation > 0 || dead) limits.wall_speed = std::max(limits.wall_speed, 1e-3);
  const bool deep =
      setup.domain == Domain::damper && depth_of_layers(setup, restitution[0]) > collapsing_depth;
  if (dead || deep) limits.pair_speed = std::max(limits.pair_speed, 1e-2);
  return limits;
}

}  // namespace shakedown
