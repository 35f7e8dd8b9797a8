// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: construction, the order of events, observation.
#pragma once
#include "event_loop.hpp"

namespace shakedown {

inline std::vector<double> rooms(const State& state, double length) {
  std::vector<double> room;
  for (const double radius : state.radius) room.push_back(length / 2 - radius);
  return room;
}

/// Dampers up to this size sweep all wall bounds after a kick; larger ones open windows.
constexpr std::size_t always_watched = 256;
/// Drag and formulas on grains act as small impulses this far apart, s; second order in it.
constexpr double grain_kick_interval = 2e-3;

/// Diameters; how high grains hop at most on what they lie on. 0.005 to 0.04 give the same peaks within the spread of runs.
constexpr double bed_hop = 0.025;

inline ElasticLimits pressed_by(double pull, ElasticLimits limits, double diameter) {
  limits.pull = pull;
  limits.wall_speed = std::max({limits.wall_speed, 1e-3, std::sqrt(2 * pull * bed_hop * diameter)});
  limits.pair_speed = std::max({limits.pair_speed, 1e-2, 2 * limits.wall_speed});
  return limits;
}

inline ElasticLimits elastic_limits(const Setup& setup, const Physics& physics) {
  ElasticLimits limits{setup.hard.wall_elastic_fraction, setup.hard.pair_elastic_speed, setup.hard.wall_elastic_speed};
  // Friction, attraction and accelerations press layers on walls that may themselves be at rest, where a fraction of the box's speed is no
  // limit at all; and clusters held together need a coarser one.
  const bool pressed = physics.contact.has_friction() || physics.contact.has_attraction() || physics.grains.arc_length != 0 ||
                       !FallingFrame(physics.grains).at_rest() || !physics.grains.free.empty() || physics.box.dry_friction > 0;
  if (pressed) {
    // A layer at rest under an acceleration keeps the speeds at which its impacts become elastic. Five grains of 10 mm fit a width of
    // 50 mm exactly, so pressed rows have hardly any play and the rate of impacts goes as the square of the acceleration over the third
    // power of that speed: with 1 mm/s some runs at 0.2 m/s^2 made 5 million impacts a second of a layer at rest. Hops of `bed_hop`
    // keep it below a hundred thousand.
    const FallingFrame frame(physics.grains);
    return pressed_by(std::hypot(frame.top(0), frame.top(1), frame.top(2)), limits, setup.grains.diameter);
  }
  // Rows of unequal grains can be longer than the box is wide across: wedged between two side walls they lose their last energy at once
  // (one run in a few hundred).
  if (physics.relative_diameter_deviation > 0) limits.wall_speed = std::max(limits.wall_speed, 1e-3);
  return limits;
}

/// Whether anything acts besides linear spring and constant restitution: what costs only those who use it.
inline bool is_driven(const Physics& physics) {
  const BoxForces& box = physics.box;
  const GrainForces& grains = physics.grains;
  return physics.contact.has_friction() || physics.contact.has_attraction() || physics.spring_cubic != 0 || box.viscous != 0 ||
         box.dry_friction != 0 || box.constant != 0 || !box.harmonics.empty() || !box.free.empty() || !grains.constant.isZero() ||
         !grains.harmonics.empty() || grains.linear_drag != 0 || grains.quadratic_drag != 0 || !grains.free.empty() || grains.arc_length != 0;
}

template <class Motion>
Motion make_box(const Physics& physics, const State& state) {
  if constexpr (std::is_same_v<Motion, DrivenBox>) return DrivenBox(physics, state.x_box, state.v_box);
  else return BoxMotion(physics.box_mass, physics.stiffness, state.x_box, state.v_box);
}

template <class Grains, class Motion>
EventLoop<Grains, Motion>::EventLoop(const State& state, const Physics& physics, const Setup& setup, Grains grains)
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
      end_walls_(has_walls_ ? rooms(state, setup.box.length) : std::vector<double>{}, state.size() <= always_watched,
                 contact_.has_attraction() ? contact_.attraction_range : 0),
      held_(contact_.has_attraction() ? state.size() : 0, contact_.attraction_force, contact_.attraction_range) {
  EXPECT(driven || (!falling_ && !contact_.has_attraction() && forces_.arc_length == 0));
  ledger_.effect_loss.assign(setup.effects.size(), 0.0);
  for (std::size_t e = 0; e < setup.effects.size(); ++e)
    if (setup.effects[e].record->name == "grain_cohesion") attraction_effect_ = static_cast<int>(e);
  if (forces_.arc_length != 0) arc_curvature_ = 0.6 / forces_.arc_length;
  if (contact_.has_friction()) spin_ = state.spin.empty() ? std::vector<Vec3>(state.size(), Vec3::Zero()) : state.spin;
  if (driven && has_walls_ && (falling_ || arc_curvature_ != 0 || contact_.has_attraction()))
    for (const double width : setup.box.width)
      side_walls_.emplace_back(rooms(state, width), state.size() <= always_watched,
                               contact_.has_attraction() ? contact_.attraction_range : 0);
  if (forces_.linear_drag > 0 || forces_.quadratic_drag > 0 || !forces_.free.empty()) {
    kick_every_ = grain_kick_interval;
    next_kick_ = kick_every_ / 2;
  }
  if (!side_walls_.empty()) grains_.forget_side_walls();
  grains_.predict_all();
  for (int i = 0; i < grains_.size(); ++i) {
    const Flight3 flight = grains_.flight(i);
    const Vec3 position(flight.x[0] - state.x_box, flight.x[1], flight.x[2]), velocity(flight.v[0], flight.v[1], flight.v[2]);
    grain_momentum_ += grains_.mass(i) * velocity;
    grain_mass_ += grains_.mass(i);
    if (!contact_.has_attraction()) continue;
    for (int axis = 0; axis < 3; ++axis)  // grains that start in the well of a wall
      for (const int side : {1, -1}) {
        const double half = (axis == 0 ? setup.box.length : setup.box.width[static_cast<std::size_t>(axis - 1)]) / 2;
        const bool inside = half - grains_.radius(i) - side * position[axis] < contact_.attraction_range;
        walls(axis).set_inside(i, side, inside);
        wells_ += inside;
      }
  }
  wells_ += grains_.bonds();
  if (has_walls_) open_windows();
  initial_momentum_ = grain_momentum_.x() + (has_spring_ ? box_.mass() * box_.v() : 0);
  initial_energy_ = observe(0).total_energy;
}

template <class Grains, class Motion>
DrivenWalls EventLoop<Grains, Motion>::walls_across(int axis) const {
  if constexpr (driven) return {&box_, &frame_, axis, arc_curvature_, release_x_};
  else return {};
}

template <class Grains, class Motion>
EndWalls::Now EventLoop<Grains, Motion>::end_walls_now() {
  if constexpr (driven) return EndWalls::now(walls_across(0), now_);
  else return {now_, box_now(), box_.top_acceleration(), box_.top_speed()};
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::open_windows() {
  const auto along = [this](int axis) {
    return [this, axis](int i) -> EndWalls::Flight {
      const Flight3 flight = grains_.flight(i);
      const auto k = static_cast<std::size_t>(axis);
      return {flight.x[k], flight.v[k], flight.time};
    };
  };
  if (end_walls_.window_end() <= now_ || events_ == 0) end_walls_.open(end_walls_now(), along(0));
  for (int axis = 1; axis <= static_cast<int>(side_walls_.size()); ++axis)
    if (walls(axis).window_end() <= now_ || events_ == 0) walls(axis).open(EndWalls::now(walls_across(axis), now_), along(axis));
}

/// Renews every bound after a kick of the box (jump != 0) or when its motion goes on with another piece.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::renew_walls(double jump) {
  if (scripted) return;
  end_walls_.kicked(end_walls_now(), jump);
  if constexpr (driven)
    if (arc_curvature_ != 0) {
      const DrivenWalls across = walls_across(2);
      side_walls_[1].kicked(EndWalls::now(across, now_), 2 * arc_curvature_ * box_now().x * jump);
    }
}

template <class Grains, class Motion>
double EventLoop<Grains, Motion>::next_event_time() {
  double next = grains_.next().time;
  if (!has_walls_) return next;
  next = std::min({next, end_walls_.next().time, end_walls_.window_end()});
  if constexpr (driven) {
    for (const EndWalls& walls : side_walls_) next = std::min({next, walls.next().time, walls.window_end()});
    next = std::min({next, box_.valid_until(), next_kick_});
  }
  return next;
}

template <class Grains, class Motion>
bool EventLoop<Grains, Motion>::advance_to(double t, const std::atomic<bool>* stop) {
  for (int count = 0; next_event_time() <= t; ++count) {
    step(t);
    if ((count & 0xfff) == 0xfff) {
      if (stop && stop->load(std::memory_order_relaxed)) return false;
      check_progress();
    }
  }
  now_ = t;
  return true;
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::advance_impacts(std::int64_t n) {
  const auto impacts = [this] { return collisions_[0] + collisions_[1] + collisions_[2]; };
  const std::int64_t target = impacts() + n;
  while (impacts() < target) {
    EXPECT(next_event_time() < never);
    step(never);
  }
}

/// One event: the earliest of the grains' own, the walls', a window's end, and what drives the box.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::step(double limit) {
  ++events_;
  const auto next = grains_.next();
  if (has_walls_) {
    double earliest = std::min(next.time, end_walls_.next().time);
    double window_end = end_walls_.window_end();
    int axis = 0;
    if constexpr (driven) {
      for (int a = 1; a <= static_cast<int>(side_walls_.size()); ++a) {
        window_end = std::min(window_end, walls(a).window_end());
        if (walls(a).next().time < std::min(earliest, walls(axis).next().time)) axis = a;
        earliest = std::min(earliest, walls(a).next().time);
      }
      const double driven_event = std::min(box_.valid_until(), next_kick_);
      if (driven_event <= std::min(earliest, window_end)) {
        now_ = std::max(now_, driven_event);
        if (next_kick_ <= driven_event) {
          kick_grains();
          return write_down(EventKind::grain_kick);
        }
        go_on();
        return write_down(EventKind::next_piece);
      }
      limit = std::min(limit, driven_event);
    }
    if (window_end <= earliest) {
      now_ = std::max(now_, window_end);
      return open_windows();
    }
    const EndWalls::Next wall = walls(axis).next();
    if (wall.time < next.time) {
      if (wall.meeting == Meeting::none) {
        if constexpr (driven) return walls(axis).refine(walls_across(axis), std::min(next.time, limit));
        else return end_walls_.refine(box_, std::min(next.time, limit));
      }
      now_ = wall.time;
      return wall_event(axis, walls(axis), wall);
    }
  }
  now_ = next.time;
  grain_event(next.grain);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::go_on() {
  if constexpr (driven) {
    box_.go_on();
    box_time_ = -1;
    renew_walls(0);
  }
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::grain_event(int i) {
  const GrainEvent event = grains_.event(i);
  if (event.partner >= 0 && !grains_.is_stale(event)) {
    if constexpr (driven)
      if (event.meeting != Meeting::touch) {
        pair_well(i, event.partner, event.meeting);
        return write_down(EventKind::pair, i, event.partner, 1, event.meeting);
      }
    pair_impact(i, event.partner);
    return write_down(EventKind::pair, i, event.partner);
  }
  if (is_side_wall(event.partner)) {
    fixed_side_impact(i, event.partner);
    return write_down(EventKind::wall, i, side_wall_axis(event.partner), side_wall_sign(event.partner));
  }
  if (event.partner == leaves_neighbourhood) {
    grains_.leave_neighbourhood(i, now_);
  } else {  // the partner has been deflected
    Flight3 flight = grains_.flight(i);
    flight.advance(now_);
    grains_.move_to(i, flight);
    grains_.predict(i);
  }
  write_down(EventKind::new_anchor, i);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::wall_event(int axis, EndWalls& walls, const EndWalls::Next& next) {
  meet_wall(axis, walls, next);
  write_down(EventKind::wall, next.grain, axis, next.side, next.meeting);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::meet_wall(int axis, EndWalls& walls, const EndWalls::Next& next) {
  if constexpr (driven)
    if (next.meeting != Meeting::touch) return wall_well(next.grain, axis, next.side, next.meeting, walls);
  if (axis == 0) end_impact(next.grain, next.side);
  else moving_side_impact(next.grain, axis, next.side);
}

/// Tells the walls of a grain's new flight.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::after(int i) {
  if (scripted || !has_walls_) return;
  const Flight3 flight = grains_.flight(i);
  end_walls_.grain_changed(i, {flight.x[0], flight.v[0], flight.time}, end_walls_now());
  if constexpr (driven)
    for (int axis = 1; axis <= static_cast<int>(side_walls_.size()); ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      walls(axis).grain_changed(i, {flight.x[k], flight.v[k], flight.time}, EndWalls::now(walls_across(axis), now_));
    }
}

/// Drag and formulas on grains: small impulses, centred, so that the error is of second order in their interval.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::kick_grains() {
  const double h = kick_every_;
  next_kick_ += h;
  account(now_);
  const BoxMotion::Point box = box_now();
  const Vec3 frame_x = frame_.displacement(now_), frame_v = frame_.velocity(now_);
  double box_impulse = 0;
  for (int i = 0; i < grains_.size(); ++i) {
    Flight3 flight = grains_.flight(i);
    flight.advance(now_);
    const double m = grains_.mass(i);
    Vec3 velocity = Vec3(flight.v[0], flight.v[1], flight.v[2]) + frame_v;
    const Vec3 before = velocity, air(box.v, 0, 0);
    if (forces_.drag_effect >= 0) {
      const Vec3 wind = velocity - air;
      velocity = air + wind * air_speed_left(wind.norm(), m, h);
      box_impulse -= m * (velocity.x() - before.x());
      ledger_.effect_loss[static_cast<std::size_t>(forces_.drag_effect)] += m / 2 * (before.squaredNorm() - velocity.squaredNorm());
    }
    for (const FreeForce& force : forces_.free) {
      const double impulse = h * force.newton(flight.x[0] + frame_x.x(), velocity.x(), now_);
      if (!std::isfinite(impulse)) throw PhysicsError("the formula of user_force on a grain is not finite at t = " + std::to_string(now_) + " s");
      ledger_.effect_loss[static_cast<std::size_t>(force.effect)] -= impulse * (velocity.x() + impulse / m / 2);
      outer_impulse_ += impulse;
      velocity.x() += impulse / m;
    }
    grain_momentum_ += m * (velocity - before);
    for (std::size_t axis = 0; axis < 3; ++axis) flight.v[axis] = velocity[static_cast<int>(axis)] - frame_v[static_cast<int>(axis)];
    grains_.set_flight(i, flight);
  }
  if (forces_.drag_effect >= 0) {
    const double jump = box_impulse / box_.mass();
    ledger_.effect_loss[static_cast<std::size_t>(forces_.drag_effect)] -= box_impulse * (box.v + jump / 2);
    box_.restart(now_, box.x, box.v + jump);
    box_point_.v += jump;
  }
  grains_.predict_all();
  for (int i = 0; i < grains_.size(); ++i) after(i);
  renew_walls(0);
}

/// What is left of a speed w after time h of drag m w' = -c1 w - c2 w |w|, as a fraction (closed form).
template <class Grains, class Motion>
double EventLoop<Grains, Motion>::air_speed_left(double speed, double mass, double h) const {
  const double rate = forces_.linear_drag / mass, square = forces_.quadratic_drag / mass * speed;
  const double lost = rate > 0 ? -std::expm1(-rate * h) / rate : h;
  return std::exp(-rate * h) / (1 + square * lost);
}

/// Adds up what the outer forces did to the grains since the last call: their momentum in the falling frame was constant.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::account(double t) {
  if constexpr (driven) {
    box_.account(t);
    if (!falling_ || t <= accounted_) return;
    constexpr std::array<double, 4> node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
    constexpr std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
    const double longest = std::min(1.0, 0.2 / std::max(frame_.top_frequency(), 1e-3));
    while (accounted_ < t) {
      const double h = std::min(longest, t - accounted_);
      for (std::size_t k = 0; k < node.size(); ++k) {
        const double time = accounted_ + h / 2 * (1 + node[k]);
        const Vec3 momentum = grain_momentum_ + grain_mass_ * frame_.velocity(time);
        frame_.each(time, [&](int effect, const Vec3& acceleration) {
          ledger_.effect_loss[static_cast<std::size_t>(effect)] -= h / 2 * weight[k] * acceleration.dot(momentum);
        });
      }
      accounted_ = h < t - accounted_ ? accounted_ + h : t;
    }
  }
}

template <class Grains, class Motion>
Observation EventLoop<Grains, Motion>::observe(double t) {
  GrainSums grains = grains_.sums(t);
  const BoxMotion::Point box = box_.at(t);
  double energy = 0, outer_impulse = outer_impulse_;
  if constexpr (driven) {
    account(t);
    const Vec3 s = frame_.displacement(t), v = frame_.velocity(t);
    grains.kinetic += Vec3(grains.momentum[0], grains.momentum[1], grains.momentum[2]).dot(v) + grains.mass * v.squaredNorm() / 2;
    grains.moment += grains.mass * s.x();
    grains.momentum[0] += grains.mass * v.x();
    outer_impulse += box_.outer_impulse() + grains.mass * v.x();
    energy -= static_cast<double>(wells_) * contact_.attraction_force * contact_.attraction_range;
  } else if (has_spring_) {
    outer_impulse += box_.spring_impulse(t);
  }
  for (std::size_t i = 0; i < spin_.size(); ++i) {
    const double m = grains_.mass(static_cast<int>(i)), r = grains_.radius(static_cast<int>(i));
    energy += 0.2 * m * r * r * spin_[i].squaredNorm();
  }
  energy += grains.kinetic;
  if (has_spring_) energy += box_.spring_energy(box.x) + box_.mass() * box.v * box.v / 2;
  const Observation seen{t, box.x, box.v, grains_.size() > 0 ? grains.moment / grains.mass : std::nan(""), energy};
  if (initial_energy_ > 0)
    worst_ledger_ = std::max(worst_ledger_, std::abs(energy + ledger().total_loss() - initial_energy_) / initial_energy_);
  if (has_spring_)
    worst_momentum_ = std::max(worst_momentum_, std::abs(grains.momentum[0] + box_.mass() * box.v - initial_momentum_ - outer_impulse));
  return seen;
}

template <class Grains, class Motion>
Ledger EventLoop<Grains, Motion>::ledger() const {
  Ledger ledger = ledger_;
  for (std::size_t c = 0; c < contact_classes; ++c) ledger.contact_loss[c] += ledger_rest_[c];
  if constexpr (driven)
    for (std::size_t e = 0; e < box_.effect_work().size(); ++e) ledger.effect_loss[e] -= box_.effect_work()[e];
  return ledger;
}

template <class Grains, class Motion>
State EventLoop<Grains, Motion>::state(double t) const {
  State state;
  const Vec3 frame_x = frame_.displacement(t), frame_v = frame_.velocity(t);
  for (int i = 0; i < grains_.size(); ++i) {
    Flight3 flight = grains_.flight(i);
    flight.advance(t);
    state.position.push_back(Vec3(flight.x[0], flight.x[1], flight.x[2]) + frame_x);
    state.velocity.push_back(Vec3(flight.v[0], flight.v[1], flight.v[2]) + frame_v);
    state.radius.push_back(grains_.radius(i));
    state.mass.push_back(grains_.mass(i));
  }
  state.spin = spin_;
  const BoxMotion::Point box = box_.at(t);
  state.x_box = box.x;
  state.v_box = box.v;
  for (std::size_t i = 0; arc_curvature_ != 0 && i < state.size(); ++i) {
    state.position[i].z() -= arc_curvature_ * (box.x * box.x - release_x_ * release_x_);
    state.velocity[i].z() -= 2 * arc_curvature_ * box.x * box.v;
  }
  return state;
}

template <class Grains, class Motion>
Health EventLoop<Grains, Motion>::health() const {
  Health health;
  health.deepest_overlap = std::max({0.0, grains_.deepest_overlap(), end_walls_.deepest_overlap()});
  for (const EndWalls& walls : side_walls_) health.deepest_overlap = std::max(health.deepest_overlap, walls.deepest_overlap());
  health.ledger_error = worst_ledger_;
  health.momentum_error = worst_momentum_;
  health.elastic_rescues = elastic_walls_ + elastic_pairs_;
  health.elastic_pair_rescues = elastic_pairs_;
  health.refused_events = refused_;
  if (let_go_ > 0)
    health.notes.push_back(std::to_string(let_go_) + " bonds of grain_cohesion hung at the edge of their well until they were pulled off with more "
                           "than its force; the energy that this leaves unpaid is booked as its work");
  return health;
}

/// Endless collisions in no time are a broken promise, not something to wait for.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::check_progress() {
  const std::int64_t patience = 2'000'000 + 20'000 * static_cast<std::int64_t>(grains_.size());
  if (now_ - time_at_check_ > 1e-5) {
    events_at_check_ = events_;
    time_at_check_ = now_;
  } else if (events_ - events_at_check_ > patience) {
    throw PhysicsError("endless collisions at t = " + std::to_string(now_) + " s (" + std::to_string(patience) +
                       " events in 10 us); raise [hard] pair_elastic_speed or wall_elastic_speed");
  }
}

}  // namespace shakedown
