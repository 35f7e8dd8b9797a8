// SPDX-License-Identifier: MIT
// The event loop takes the earliest of what the grains and the walls announce, executes it, and asks those
// concerned for their next events. `Grains` finds pair and side-wall events (AllPairs for few grains,
// CellLists or CellCrossings for many); EndWalls finds those with moving walls. With a driven box grains are
// described in a frame that falls with them, and the side walls are EndWalls too where they move or attract.
#pragma once
#include <atomic>
#include <bit>
#include <string>

#include "event_log.hpp"
#include "fnv.hpp"
#include "grain_kicks.hpp"
#include "impacts.hpp"

namespace shakedown {

/// `Motion` is the box, BoxMotion or DrivenBox (scene.hpp). `Grains` is AllPairs, CellLists, CellCrossings,
/// or ScriptedGrains for a replay. Such a type has these members (i and j number grains from 0; SI):
///   size()                returns the number of grains
///   flight(i)             returns the Flight3 of grain i
///   set_flight(i, flight) gives grain i a new flight after an impact; what was predicted with it is stale
///   move_to(i, flight)    describes the flight that grain i is on from another of its points
///   radius(i), mass(i)    return the radius, m, and the mass, kg
///   separation(a, b)      returns the vector from a to b, flights of one time; in periodic cells to the
///                         nearest image of b
///   sums(t)               returns the GrainSums at time t
///   Next next()           returns {time, grain} of the earliest event that the grains know of
///   event(i)              returns the GrainEvent of grain i, that of next() for next().grain
///   is_stale(event)       tells whether the partner of the event has been deflected since it was predicted
///   predict(i), predict(i, j), predict_all()
///                         find the next events of these grains, whose flights start now
///   predict_all_before(t) may be missing: predict_all() that may leave out touches after time t
///   leave_neighbourhood(i, now)
///                         executes an event whose partner is `leaves_neighbourhood`
///   set_bond(i, j, bond), bonds()
///                         enter whether two grains share a square well; return how many pairs do
///   forget_side_walls()   leaves the side walls to EndWalls
///   deepest_overlap()     returns the deepest overlap of two grains seen so far, m
///   bytes_per_grain()     returns the memory held for each grain
///   scripted              a static member that stands only in types whose events come from a log
template <class Grains, class Motion>
class EventLoop {
 public:
  static constexpr bool driven = Scene<Grains, Motion>::driven;
  static constexpr bool scripted = Scene<Grains, Motion>::scripted;

  EventLoop(const State& state, const Physics& physics, const Setup& setup, Grains grains);
  EventLoop(const EventLoop&) = delete;  // its parts refer to each other
  EventLoop& operator=(const EventLoop&) = delete;

  /// Executes every event before time t; returns false when `stop` was set.
  bool advance_to(double t, const std::atomic<bool>* stop = nullptr);
  /// Executes n more impacts (of any class).
  void advance_impacts(std::int64_t n);

  /// Every event from now on is written down there; the writer must outlive the loop.
  void write_events_to(EventWriter* writer) { writer_ = writer; }
  /// Executes an event of a log (scripted loops only).
  void execute(const LoggedEvent& event);
  /// Moves the clock on to time t (s); no event of the log may lie before.
  void wait_until(double t) { scene_.now = t; }
  /// Returns a digest of the whole state: FNV-1a over the bits of all flights, spins and the box.
  std::uint64_t digest() const;

  double time() const { return scene_.now; }  ///< s, up to which the events are executed
  /// Returns the motion at time(), and enters how far energy and momentum are off balance.
  Observation observe() { return accounts_.observe(held()); }
  /// Returns grains and box at time t (s), each on its present flight; lab frame.
  State state(double t) const;
  /// Returns the energy that contacts and effects have taken since the start, J.
  Ledger ledger() const { return accounts_.ledger(); }
  /// Returns overlaps so far and the balances as observe() last found them.
  Health health() const;
  /// Returns the number of impacts by ContactClass.
  const std::array<std::int64_t, contact_classes>& collisions() const { return accounts_.collisions(); }
  /// Returns the number of steps so far: impacts, and everything else that the loop has dealt with.
  std::int64_t events() const { return events_; }
  double initial_energy() const { return accounts_.initial_energy(); }  ///< J
  /// Returns the sum over pair impacts of impulse times distance, N s m: 3 N k T (Z - 1) times the time that
  /// it was summed over.
  double virial() const { return impacts_.virial(); }
  double bytes_per_grain() const {
    return scene_.grains.bytes_per_grain() + walls_.bytes_per_grain(scene_.grains.size());
  }

 private:
  using Parts = Scene<Grains, Motion>;

  /// Returns the time of the next event of any kind, s; `never` where there is none.
  double next_event_time();
  /// `limit`: s, beyond which bounds at walls need not be made sharper.
  void step(double limit);
  bool step_of_walls(double next_of_grains, double limit);
  void step_of_motion();
  void grain_event(int i);
  void touch_wall(int i, int axis, int side);
  void meet_wall(int axis, const EndWalls::Next& next);
  void next_piece();
  /// Describes the flight of grain i from now on, and predicts its next event where asked to.
  void new_anchor(int i, bool predict);
  void check_progress();
  typename LoopAccounts<Parts>::Held held() const { return {impacts_.spin(), driven ? wells_.energy() : 0}; }
  void write_down(EventKind kind, int grain = 0, int partner = 0, int side = 1,
                  Meeting meeting = Meeting::touch) {
    if (writer_ != nullptr) [[unlikely]]
      if (writer_->add({scene_.now, kind, grain, partner, side, meeting})) writer_->add_digest(digest());
  }

  Parts scene_;
  LoopWalls<Parts> walls_;
  LoopAccounts<Parts> accounts_;
  Partings<Parts> partings_;
  Wells<Parts> wells_;
  Impacts<Parts> impacts_;
  GrainKicks<Parts> kicks_;

  std::int64_t events_ = 0, events_at_check_ = 0;
  double time_at_check_ = 0;
  EventWriter* writer_ = nullptr;
};

template <class Grains, class Motion>
EventLoop<Grains, Motion>::EventLoop(const State& state, const Physics& physics, const Setup& setup,
                                     Grains grains)
    : scene_(state, physics, setup, std::move(grains)),
      walls_(scene_, state, physics, setup),
      accounts_(scene_, physics, setup),
      partings_(scene_, walls_, accounts_),
      wells_(scene_, walls_, accounts_, partings_, physics.contact),
      impacts_(scene_, walls_, accounts_, partings_, wells_),
      kicks_(scene_, walls_, accounts_, physics.grains, setup.hard.kick_interval) {
  impacts_.start(state, physics, setup);
  scene_.grains.predict_all();
  wells_.start(state, setup);
  if (scene_.has_walls) walls_.open_windows(true);
  accounts_.open(held());
}

template <class Grains, class Motion>
double EventLoop<Grains, Motion>::next_event_time() {
  const double next = scene_.grains.next().time;
  if (!scene_.has_walls) return next;
  const auto first = walls_.first(next);
  const double of_walls = std::min(first.time, first.window_end);
  if constexpr (driven) return std::min({of_walls, scene_.box.valid_until(), kicks_.next()});
  return of_walls;
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
  scene_.now = t;
  return true;
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::advance_impacts(std::int64_t n) {
  const auto impacts = [this] { return collisions()[0] + collisions()[1] + collisions()[2]; };
  const std::int64_t target = impacts() + n;
  while (impacts() < target) {
    EXPECT(next_event_time() < never);
    step(never);
  }
}

/// Executes one event: the earliest of the grains' own, the walls', a window's end, and what drives box and
/// grains.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::step(double limit) {
  ++events_;
  const auto next = scene_.grains.next();
  if (scene_.has_walls && step_of_walls(next.time, limit)) return;
  scene_.now = next.time;
  grain_event(next.grain);
}

/// Takes one step at the walls or of what drives box and grains; returns false, and does nothing, when the
/// grains' own next event is the earliest.
template <class Grains, class Motion>
bool EventLoop<Grains, Motion>::step_of_walls(double next_of_grains, double limit) {
  const auto first = walls_.first(next_of_grains);
  if constexpr (driven) {
    const double motion = std::min(scene_.box.valid_until(), kicks_.next());
    if (motion <= std::min(first.time, first.window_end)) {
      scene_.now = std::max(scene_.now, motion);
      step_of_motion();
      return true;
    }
    limit = std::min(limit, motion);
  }
  if (first.window_end <= first.time) {
    scene_.now = std::max(scene_.now, first.window_end);
    walls_.open_windows();
    return true;
  }
  const EndWalls::Next wall = walls_.across(first.axis).next();
  if (!(wall.time < next_of_grains)) return false;
  if (wall.meeting == Meeting::none) {
    walls_.refine(first.axis, std::min(next_of_grains, limit));
    return true;
  }
  scene_.now = wall.time;
  meet_wall(first.axis, wall);
  write_down(EventKind::wall, wall.grain, first.axis, wall.side, wall.meeting);
  return true;
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::step_of_motion() {
  if (kicks_.next() <= scene_.box.valid_until()) {
    kicks_.act();
    return write_down(EventKind::grain_kick);
  }
  next_piece();
  write_down(EventKind::next_piece);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::next_piece() {
  if constexpr (driven) {
    scene_.next_piece_of_box();
    walls_.renew(0);
  }
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::meet_wall(int axis, const EndWalls::Next& next) {
  if constexpr (driven)
    if (next.meeting != Meeting::touch) return wells_.wall_edge(next.grain, axis, next.side, next.meeting);
  touch_wall(next.grain, axis, next.side);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::touch_wall(int i, int axis, int side) {
  if (axis == 0)
    impacts_.end_wall(i, side);
  else
    impacts_.side_wall(i, axis, side);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::grain_event(int i) {
  const GrainEvent event = scene_.grains.event(i);
  if (event.partner >= 0 && !scene_.grains.is_stale(event)) {
    if constexpr (driven)
      if (event.meeting != Meeting::touch) {
        wells_.pair_edge(i, event.partner, event.meeting);
        return write_down(EventKind::pair, i, event.partner, 1, event.meeting);
      }
    impacts_.pair(i, event.partner);
    return write_down(EventKind::pair, i, event.partner);
  }
  if (is_side_wall(event.partner)) {
    const int axis = side_wall_axis(event.partner), side = side_wall_sign(event.partner);
    impacts_.side_wall(i, axis, side);
    return write_down(EventKind::wall, i, axis, side);
  }
  if (event.partner == leaves_neighbourhood)
    scene_.grains.leave_neighbourhood(i, scene_.now);
  else
    new_anchor(i, true);  // the partner has been deflected
  write_down(EventKind::new_anchor, i);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::new_anchor(int i, bool predict) {
  scene_.grains.move_to(i, partings_.flight_now(i));
  if (predict) scene_.grains.predict(i);
}

/// Throws PhysicsError when more than two million events and 20 000 a grain fall within 10 us of motion: the
/// run would never end.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::check_progress() {
  const std::int64_t patience = 2'000'000 + 20'000 * static_cast<std::int64_t>(scene_.grains.size());
  if (scene_.now - time_at_check_ > 1e-5) {
    events_at_check_ = events_;
    time_at_check_ = scene_.now;
  } else if (events_ - events_at_check_ > patience) {
    throw PhysicsError(
        "endless collisions at t = " + std::to_string(scene_.now) + " s (" + std::to_string(patience) +
        " events in 10 us); where a restitution is 0 take 0.02, where grains fill the box to its walls "
        "leave them 1 % of a diameter, else raise [hard] pair_elastic_speed or wall_elastic_speed, "
        "or take --engine soft");
  }
}

/// Executes the impact with the same code that executed it at first; only that it happens, and when, is taken
/// from the log.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::execute(const LoggedEvent& event) {
  static_assert(scripted);
  scene_.now = event.time;
  ++events_;
  switch (event.kind) {
    case EventKind::pair:
      if (event.meeting != Meeting::touch) return wells_.pair_edge(event.grain, event.partner, event.meeting);
      return impacts_.pair(event.grain, event.partner);
    case EventKind::wall:
      if (event.meeting != Meeting::touch && (event.partner == 0 || walls_.has_sides()))
        return meet_wall(event.partner, {event.time, event.grain, event.side, event.meeting});
      return touch_wall(event.grain, event.partner, event.side);
    case EventKind::new_anchor: return new_anchor(event.grain, false);
    case EventKind::grain_kick:
      if (kicks_.next() < never) kicks_.act();  // else nothing kicks: the log was edited, as its digests tell
      return;
    case EventKind::next_piece: return next_piece();
  }
}

template <class Grains, class Motion>
std::uint64_t EventLoop<Grains, Motion>::digest() const {
  std::uint64_t hash = fnv_start;
  const auto mix = [&hash](double value) { hash = fnv_step(hash, std::bit_cast<std::uint64_t>(value)); };
  for (int i = 0; i < scene_.grains.size(); ++i) {
    const Flight3 flight = scene_.grains.flight(i);
    for (std::size_t axis = 0; axis < 3; ++axis) mix(flight.x[axis]), mix(flight.v[axis]);
    mix(flight.time);
  }
  for (const Vec3& spin : impacts_.spin())
    for (const double value : spin) mix(value);
  mix(scene_.box.x()), mix(scene_.box.v()), mix(scene_.box.time());
  return hash;
}

template <class Grains, class Motion>
State EventLoop<Grains, Motion>::state(double t) const {
  State state = scene_.state(t);
  state.spin = impacts_.spin();
  return state;
}

template <class Grains, class Motion>
Health EventLoop<Grains, Motion>::health() const {
  Health health;
  health.deepest_overlap = std::max({0.0, scene_.grains.deepest_overlap(), walls_.deepest_overlap()});
  health.ledger_error = accounts_.ledger_error();
  health.momentum_error = accounts_.momentum_error();
  health.elastic_rescues = impacts_.elastic_walls() + impacts_.elastic_pairs();
  health.elastic_pair_rescues = impacts_.elastic_pairs();
  health.refused_events = partings_.refused();
  if (wells_.let_any_go())
    health.notes.push_back(
        "bonds of grain_cohesion hung at the edge of their well until they were pulled off with more than "
        "its force; the energy "
        "that this leaves unpaid is booked as its work");
  return health;
}

}  // namespace shakedown
