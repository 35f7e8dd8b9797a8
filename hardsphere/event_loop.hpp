// SPDX-License-Identifier: MIT
// The event loop: takes the earliest of what the grains and the end walls announce, executes it, and asks those concerned for news.
// `Grains` finds pair and side-wall events (AllPairs for few grains, CellLists for many); EndWalls those with the moving walls.
#pragma once
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "box_motion.hpp"
#include "end_walls.hpp"
#include "grain_event.hpp"
#include "initial_state.hpp"
#include "hard_sphere_system.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// Below which closing speeds impacts are elastic (the regularisation of inelastic collapse).
struct ElasticLimits {
  double wall_fraction = 0.02;  ///< of the box's current top speed, end walls
  double pair_speed = 1e-3;     ///< m/s
  double wall_speed = 0;        ///< m/s, end and side walls
};


template <class Grains>
class EventLoop {
 public:
  EventLoop(const State& state, const Physics& physics, const Setup& setup, Grains grains);

  /// Executes every event before time t; returns false when `stop` was set.
  bool advance_to(double t, const std::atomic<bool>* stop = nullptr);
  /// Executes n more impacts (of any class).
  void advance_impacts(std::int64_t n);

  double time() const { return now_; }
  Observation observe(double t);
  State state(double t) const;
  Ledger ledger() const {
    Ledger ledger = ledger_;
    for (std::size_t c = 0; c < contact_classes; ++c) ledger.contact_loss[c] += ledger_rest_[c];
    return ledger;
  }
  Health health() const;
  const std::array<std::int64_t, contact_classes>& collisions() const { return collisions_; }
  std::int64_t events() const { return events_; }
  double initial_energy() const { return initial_energy_; }
  /// Sum over pair impacts of impulse times distance, N s m: 3 N k T (Z - 1) times the time it was summed over.
  double virial() const { return virial_; }
  double bytes_per_grain() const { return grains_.bytes_per_grain() + walls_.bytes_per_grain(); }

 private:
  void step(double limit);
  void pair_impact(int i, int j);
  void side_impact(int i, std::int32_t face);
  void end_impact(int i, int side);
  void grain_event(int i);
  void open_window();
  void after(int i);
  double box_energy(BoxMotion::Point box) const;
  EndWalls::Flight axial(int i) const {
    const Flight3 flight = grains_.flight(i);
    return {flight.x[0], flight.v[0], flight.time};
  }
  void check_progress();
  /// Adds to the ledger with Neumaier's compensation: millions of small losses must not cost the closure its digits.
  void lose(std::size_t contact_class, double energy) {
    double& sum = ledger_.contact_loss[contact_class];
    const double next = sum + energy;
    ledger_rest_[contact_class] += std::abs(sum) >= std::abs(energy) ? (sum - next) + energy : (energy - next) + sum;
    sum = next;
  }
  /// The box at now_; several callers of one event share it.
  BoxMotion::Point box_now() {
    if (now_ != box_time_) box_point_ = box_.at(now_), box_time_ = now_;
    return box_point_;
  }

  ContactLaw contact_;
  ElasticLimits limits_;
  Grains grains_;
  BoxMotion box_;
  bool has_walls_, has_spring_;
  EndWalls walls_;
  double now_ = 0, box_time_ = -1;
  BoxMotion::Point box_point_{};
  Ledger ledger_;
  std::array<double, contact_classes> ledger_rest_{};
  std::array<std::int64_t, contact_classes> collisions_{};
  std::int64_t events_ = 0, refused_ = 0, elastic_walls_ = 0, elastic_pairs_ = 0;
  double initial_energy_ = 0, initial_momentum_ = 0, spring_impulse_ = 0, virial_ = 0;
  double worst_ledger_ = 0, worst_momentum_ = 0;
  std::int64_t events_at_check_ = 0;
  double time_at_check_ = 0;
};

// ---------------------------------------------------------------------------------------------------------------------------------

inline std::vector<double> wall_rooms(const State& state, double length) {
  std::vector<double> room;
  for (const double radius : state.radius) room.push_back(length / 2 - radius);
  return room;
}

/// Dampers up to this size sweep all wall bounds after a kick; larger ones open windows.
constexpr std::size_t always_watched = 256;

template <class Grains>
EventLoop<Grains>::EventLoop(const State& state, const Physics& physics, const Setup& setup, Grains grains)
    : contact_(physics.contact),
      limits_{setup.hard.wall_elastic_fraction, setup.hard.pair_elastic_speed, setup.hard.wall_elastic_speed},
      grains_(std::move(grains)),
      box_(physics.box_mass, physics.stiffness, state.x_box, state.v_box),
      has_walls_(setup.domain != Domain::periodic),
      has_spring_(setup.domain == Domain::damper),
      walls_(has_walls_ ? wall_rooms(state, setup.box.length) : std::vector<double>{}, state.size() <= always_watched) {
  ledger_.effect_loss.assign(setup.effects.size(), 0.0);
  grains_.predict_all();
  if (has_walls_) open_window();
  initial_momentum_ = has_spring_ ? box_.mass() * box_.v() : 0;
  for (int i = 0; i < grains_.size(); ++i) initial_momentum_ += grains_.mass(i) * grains_.flight(i).v[0];
  initial_energy_ = observe(0).total_energy;
}

template <class Grains>
void EventLoop<Grains>::open_window() {
  walls_.open(now_, box_, [this](int i) { return axial(i); });
}

template <class Grains>
bool EventLoop<Grains>::advance_to(double t, const std::atomic<bool>* stop) {
  for (int count = 0;; ++count) {
    const double next = std::min(grains_.next().time, has_walls_ ? std::min(walls_.next().time, walls_.window_end()) : never);
    if (next > t) break;
    step(t);
    if ((count & 0xfff) == 0xfff) {
      if (stop && stop->load(std::memory_order_relaxed)) return false;
      check_progress();
    }
  }
  now_ = t;
  return true;
}

template <class Grains>
void EventLoop<Grains>::advance_impacts(std::int64_t n) {
  const auto impacts = [this] { return collisions_[0] + collisions_[1] + collisions_[2]; };
  const std::int64_t target = impacts() + n;
  while (impacts() < target) {
    EXPECT(std::min(grains_.next().time, walls_.next().time) < never);
    step(never);
  }
}

/// One event: the earliest of the grains' own, the end walls' and the window's end.
template <class Grains>
void EventLoop<Grains>::step(double limit) {
  ++events_;
  const auto next = grains_.next();
  if (has_walls_) {
    const EndWalls::Next& wall = walls_.next();
    const double earliest = std::min(next.time, wall.time);
    if (walls_.window_end() <= earliest) {
      now_ = std::max(now_, walls_.window_end());
      return open_window();
    }
    if (wall.time < next.time) {
      if (!wall.certain) return walls_.refine(box_, std::min(next.time, limit));
      now_ = wall.time;
      return end_impact(wall.grain, wall.side);
    }
  }
  now_ = next.time;
  grain_event(next.grain);
}

template <class Grains>
void EventLoop<Grains>::grain_event(int i) {
  const GrainEvent event = grains_.event(i);
  if (event.partner >= 0 && !grains_.is_stale(event)) return pair_impact(i, event.partner);
  if (is_side_wall(event.partner)) return side_impact(i, event.partner);
  Flight3 flight = grains_.flight(i);  // the partner has been deflected, or the grain leaves its neighbourhood
  flight.advance(now_);
  grains_.move_to(i, flight);
  if (event.partner == leaves_neighbourhood) grains_.leave_neighbourhood(i);
  grains_.predict(i);
}

/// Smooth inelastic impact of two spheres: impulse mu (1 + eps) times the closing speed along the line of centres.
template <class Grains>
void EventLoop<Grains>::pair_impact(int i, int j) {
  Flight3 a = grains_.flight(i), b = grains_.flight(j);
  a.advance(now_);
  b.advance(now_);
  const auto r = grains_.separation(a, b);
  const double distance = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  const double closing = -(r[0] * (b.v[0] - a.v[0]) + r[1] * (b.v[1] - a.v[1]) + r[2] * (b.v[2] - a.v[2])) / distance;
  if (closing <= 0) {
    ++refused_;
    grains_.move_to(i, a);
    return grains_.predict(i);
  }
  double restitution = contact_.restitution[0];
  if (closing < limits_.pair_speed && restitution < 1) {
    restitution = 1;
    ++elastic_pairs_;
  }
  const double ma = grains_.mass(i), mb = grains_.mass(j), reduced = ma * mb / (ma + mb);
  const double impulse = reduced * (1 + restitution) * closing;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double along = impulse * r[axis] / distance;
    a.v[axis] -= along / ma;
    b.v[axis] += along / mb;
  }
  lose(0, reduced / 2 * (1 - restitution * restitution) * closing * closing);
  ++collisions_[0];
  virial_ += impulse * distance;
  grains_.set_flight(i, a);
  grains_.set_flight(j, b);
  grains_.predict(i, j);
  after(i);
  after(j);
}

template <class Grains>
void EventLoop<Grains>::side_impact(int i, std::int32_t face) {
  Flight3 flight = grains_.flight(i);
  flight.advance(now_);
  const std::size_t axis = static_cast<std::size_t>(side_wall_axis(face));
  const double closing = side_wall_sign(face) * flight.v[axis];
  EXPECT(closing > 0);
  double restitution = contact_.restitution[2];
  if (closing < limits_.wall_speed && restitution < 1) {
    restitution = 1;
    ++elastic_walls_;
  }
  flight.v[axis] *= -restitution;
  lose(2, grains_.mass(i) / 2 * (1 - restitution * restitution) * closing * closing);
  ++collisions_[2];
  grains_.set_flight(i, flight);
  grains_.predict(i);
  after(i);
}

/// Impact on an end wall: the box takes the opposite impulse (paper, Sec. II B, with v_Box' = v_Box + dp / M).
template <class Grains>
void EventLoop<Grains>::end_impact(int i, int side) {
  Flight3 flight = grains_.flight(i);
  flight.advance(now_);
  const BoxMotion::Point box = box_now();
  const double closing = side * (flight.v[0] - box.v);
  if (closing <= 0) {
    ++refused_;
    grains_.move_to(i, flight);
    grains_.predict(i);
    return after(i);
  }
  const double limit = std::max(limits_.wall_fraction * box_.top_speed(), limits_.wall_speed);
  double restitution = contact_.restitution[1];
  if (closing < limit && restitution < 1) {
    restitution = 1;
    ++elastic_walls_;
  }
  const double m = grains_.mass(i), reduced = has_spring_ ? m * box_.mass() / (m + box_.mass()) : m;
  const double impulse = reduced * (1 + restitution) * closing;
  flight.v[0] -= side * impulse / m;
  lose(1, reduced / 2 * (1 - restitution * restitution) * closing * closing);
  ++collisions_[1];
  if (has_spring_) {
    const double jump = side * impulse / box_.mass();
    spring_impulse_ += box_.spring_impulse(now_);
    box_.restart(now_, box.x, box.v + jump);
    box_point_.v += jump;
    grains_.set_flight(i, flight);
    grains_.predict(i);
    walls_.grain_changed(i, {flight.x[0], flight.v[0], now_}, now_, {box_.x(), box_.v()}, box_.top_acceleration());
    walls_.box_kicked(now_, box_, jump);
  } else {
    grains_.set_flight(i, flight);
    grains_.predict(i);
    after(i);
  }
}

/// Tells the end walls of a grain's new flight.
template <class Grains>
void EventLoop<Grains>::after(int i) {
  if (has_walls_) walls_.grain_changed(i, axial(i), now_, box_now(), box_.top_acceleration());
}

template <class Grains>
double EventLoop<Grains>::box_energy(BoxMotion::Point box) const {
  if (!has_spring_) return 0;
  return box_.stiffness() * box.x * box.x / 2 + box_.mass() * box.v * box.v / 2;
}

template <class Grains>
Observation EventLoop<Grains>::observe(double t) {
  const GrainSums grains = grains_.sums(t);
  const BoxMotion::Point box = box_.at(t);
  const Observation seen{t, box.x, box.v, grains_.size() > 0 ? grains.moment / grains.mass : std::nan(""), grains.kinetic + box_energy(box)};
  if (initial_energy_ > 0)
    worst_ledger_ = std::max(worst_ledger_,
                             std::abs(seen.total_energy + ledger().total_loss() - initial_energy_) / initial_energy_);
  if (has_spring_) {
    const double momentum = grains.momentum + box_.mass() * box.v;
    worst_momentum_ = std::max(worst_momentum_,
                               std::abs(momentum - initial_momentum_ - spring_impulse_ - box_.spring_impulse(t)));
  }
  return seen;
}

template <class Grains>
State EventLoop<Grains>::state(double t) const {
  State state;
  for (int i = 0; i < grains_.size(); ++i) {
    Flight3 flight = grains_.flight(i);
    flight.advance(t);
    state.position.emplace_back(flight.x[0], flight.x[1], flight.x[2]);
    state.velocity.emplace_back(flight.v[0], flight.v[1], flight.v[2]);
    state.radius.push_back(grains_.radius(i));
    state.mass.push_back(grains_.mass(i));
  }
  const BoxMotion::Point box = box_.at(t);
  state.x_box = box.x;
  state.v_box = box.v;
  return state;
}

template <class Grains>
Health EventLoop<Grains>::health() const {
  Health health;
  health.deepest_overlap = std::max({0.0, grains_.deepest_overlap(), walls_.deepest_overlap()});
  health.ledger_error = worst_ledger_;
  health.momentum_error = worst_momentum_;
  health.elastic_rescues = elastic_walls_ + elastic_pairs_;
  health.elastic_pair_rescues = elastic_pairs_;
  health.refused_events = refused_;
  return health;
}

/// Endless collisions in no time are a broken promise, not something to wait for.
template <class Grains>
void EventLoop<Grains>::check_progress() {
  constexpr std::int64_t patience = 20'000'000;
  if (now_ - time_at_check_ > 1e-7) {
    events_at_check_ = events_;
    time_at_check_ = now_;
  } else if (events_ - events_at_check_ > patience) {
    throw PhysicsError("endless collisions at t = " + std::to_string(now_) + " s (" + std::to_string(patience) +
                       " events in 0.1 us); raise [hard] pair_elastic_speed or wall_elastic_speed");
  }
}

}  // namespace shakedown
