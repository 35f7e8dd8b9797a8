// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: from a setup to a loop that knows its first event.
#pragma once
#include <algorithm>
#include <array>
#include <numbers>

#include "event_loop.hpp"

namespace shakedown {

inline std::vector<double> rooms(const State& state, double length) {
  std::vector<double> room;
  for (const double radius : state.radius) room.push_back(length / 2 - radius);
  return room;
}

/// Dampers up to this size sweep all wall bounds after a kick; larger ones open windows.
constexpr std::size_t always_watched = 256;

/// Diameters; how high grains hop at most on what they lie on. 0.005 to 0.04 give the same peaks within the
/// spread of runs.
constexpr double bed_hop = 0.025;

/// Restitutions below this stall rows between side walls. 0.5 does not, in 100 runs of 22 s; 0.3 of all walls
/// does, in a few runs.
constexpr double dead_restitution = 0.5;

inline ElasticLimits pressed_by(double pull, ElasticLimits limits, double diameter) {
  limits.pull = pull;
  limits.wall_speed = std::max({limits.wall_speed, 1e-3, std::sqrt(2 * pull * bed_hop * diameter)});
  limits.pair_speed = std::max({limits.pair_speed, 1e-2, 2 * limits.wall_speed});
  return limits;
}

inline ElasticLimits elastic_limits(const Setup& setup, const Physics& physics) {
  ElasticLimits limits{setup.hard.wall_elastic_fraction, setup.hard.pair_elastic_speed,
                       setup.hard.wall_elastic_speed};
  // Friction, attraction and accelerations press layers on walls that may themselves be at rest, where a
  // fraction of the box's speed is no limit at all; and clusters held together need a coarser one.
  const bool pressed = physics.contact.has_friction() || physics.contact.has_attraction() ||
                       physics.grains.arc_length != 0 || !FallingFrame(physics.grains).at_rest() ||
                       !physics.grains.free.empty() || physics.box.dry_friction > 0;
  if (pressed) {
    // A layer at rest under an acceleration keeps the speeds at which its impacts become elastic. Five grains
    // of 10 mm fit a width of 50 mm exactly, so pressed rows have hardly any play and the rate of impacts
    // goes as the square of the acceleration over the third power of that speed: with 1 mm/s some runs at 0.2
    // m/s^2 made 5 million impacts a second of a layer at rest. Hops of `bed_hop` keep it below a hundred
    // thousand.
    const FallingFrame frame(physics.grains);
    return pressed_by(std::hypot(frame.top(0), frame.top(1), frame.top(2)), limits, setup.grains.diameter);
  }
  // Rows of unequal grains can be longer than the box is wide across: wedged between two side walls they lose
  // their last energy at once (one run in a few hundred). So do rows of equal ones where little of it comes
  // back (side walls of 0.1: one run in fifty).
  const std::array<double, contact_classes>& restitution = physics.contact.restitution;
  const bool dead = *std::min_element(restitution.begin(), restitution.end()) < dead_restitution;
  if (physics.relative_diameter_deviation > 0 || dead) limits.wall_speed = std::max(limits.wall_speed, 1e-3);
  if (dead) limits.pair_speed = std::max(limits.pair_speed, 1e-2);
  return limits;
}

/// Whether anything acts besides linear spring and constant restitution: what costs only those who use it.
inline bool is_driven(const Physics& physics) {
  const BoxForces& box = physics.box;
  const GrainForces& grains = physics.grains;
  return physics.contact.has_friction() || physics.contact.has_attraction() || physics.spring_cubic != 0 ||
         box.viscous != 0 || box.dry_friction != 0 || box.constant != 0 || !box.harmonics.empty() ||
         !box.free.empty() || !grains.constant.isZero() || !grains.harmonics.empty() ||
         grains.linear_drag != 0 || grains.quadratic_drag != 0 || !grains.free.empty() ||
         grains.arc_length != 0;
}

template <class Motion>
Motion make_box(const Physics& physics, const State& state) {
  if constexpr (std::is_same_v<Motion, DrivenBox>)
    return DrivenBox(physics, state.x_box, state.v_box);
  else
    return BoxMotion(physics.box_mass, physics.stiffness, state.x_box, state.v_box);
}

template <class Grains, class Motion>
EventLoop<Grains, Motion>::EventLoop(const State& state, const Physics& physics, const Setup& setup,
                                     Grains grains)
    : contact_(physics.contact),
      forces_(physics.grains),
      limits_(elastic_limits(setup, physics)),
      limits_at_release_(limits_),
      grains_(std::move(grains)),
      box_(make_box<Motion>(physics, state)),
      speed_at_release_(box_.top_speed()),
      frame_(physics.grains),
      falling_(!frame_.at_rest()),
      has_walls_(setup.domain != Domain::periodic),
      has_spring_(setup.domain == Domain::damper),
      release_x_(state.x_box),
      end_walls_(has_walls_ ? rooms(state, setup.box.length) : std::vector<double>{},
                 state.size() <= always_watched, contact_.has_attraction() ? contact_.attraction_range : 0),
      held_(contact_.has_attraction() ? state.size() : 0, contact_.attraction_force,
            contact_.attraction_range),
      momentum_scale_(setup.box.mass * 2 * std::numbers::pi * setup.spring.frequency *
                      std::abs(setup.release.displacement)) {
  EXPECT(driven || (!falling_ && !contact_.has_attraction() && forces_.arc_length == 0));
  ledger_.effect_loss.assign(setup.effects.size(), 0.0);
  for (std::size_t e = 0; e < setup.effects.size(); ++e)
    if (setup.effects[e].record->name == "grain_cohesion") attraction_effect_ = static_cast<int>(e);
  if (forces_.arc_length != 0) arc_curvature_ = 0.6 / forces_.arc_length;
  if (contact_.has_friction()) {
    spin_ = state.spin.empty() ? std::vector<Vec3>(state.size(), Vec3::Zero()) : state.spin;
    touched_.assign(state.size(), -1.0);
  }
  if (driven && has_walls_ && (falling_ || arc_curvature_ != 0 || contact_.has_attraction()))
    for (const double width : setup.box.width)
      side_walls_.emplace_back(rooms(state, width), state.size() <= always_watched,
                               contact_.has_attraction() ? contact_.attraction_range : 0);
  if (forces_.linear_drag > 0 || forces_.quadratic_drag > 0 || !forces_.free.empty()) {
    kick_every_ = setup.hard.kick_interval;
    next_kick_ = kick_every_ / 2;
  }
  if (!side_walls_.empty()) grains_.forget_side_walls();
  if (const double across = 2 * arc_curvature_ * state.x_box * state.v_box; across != 0)
    for (int i = 0; i < grains_.size(); ++i) {  // states are as seen from the box, flights are in the lab
      Flight3 flight = grains_.flight(i);
      flight.v[2] += across;
      grains_.move_to(i, flight);
    }
  grains_.predict_all();
  for (int i = 0; i < grains_.size(); ++i) {
    const Flight3 flight = grains_.flight(i);
    const Vec3 position(flight.x[0] - state.x_box, flight.x[1], flight.x[2]),
        velocity(flight.v[0], flight.v[1], flight.v[2]);
    grain_momentum_ += grains_.mass(i) * velocity;
    grain_mass_ += grains_.mass(i);
    if (setup.release.displacement == 0) momentum_scale_ += grains_.mass(i) * velocity.norm();
    if (!contact_.has_attraction()) continue;
    for (int axis = 0; axis < 3; ++axis)  // grains that start in the well of a wall
      for (const int side : {1, -1}) {
        const double half =
            (axis == 0 ? setup.box.length : setup.box.width[static_cast<std::size_t>(axis - 1)]) / 2;
        const bool inside = half - grains_.radius(i) - side * position[axis] < contact_.attraction_range;
        walls(axis).set_inside(i, side, inside);
        wells_ += inside;
      }
  }
  wells_ += grains_.bonds();
  if (has_walls_) open_windows();
  initial_momentum_ = grain_momentum_.x() + (has_spring_ ? box_.mass() * box_.v() : 0);
  initial_energy_ = observe().total_energy;
  energy_book_ = {};  // it was opened without knowing that
}

}  // namespace shakedown
