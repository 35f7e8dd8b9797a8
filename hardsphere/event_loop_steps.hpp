// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: the order of events, and what grains do by themselves.
#pragma once
#include "event_loop.hpp"

namespace shakedown {

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
        if constexpr (driven)
          return walls(axis).refine(walls_across(axis), std::min(next.time, limit));
        else
          return end_walls_.refine(box_, std::min(next.time, limit));
      }
      now_ = wall.time;
      return wall_event(axis, walls(axis), wall);
    }
  }
  now_ = next.time;
  grain_event(next.grain);
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

/// Endless collisions in no time are a broken promise, not something to wait for.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::check_progress() {
  const std::int64_t patience = 2'000'000 + 20'000 * static_cast<std::int64_t>(grains_.size());
  if (now_ - time_at_check_ > 1e-5) {
    events_at_check_ = events_;
    time_at_check_ = now_;
  } else if (events_ - events_at_check_ > patience) {
    throw PhysicsError("endless collisions at t = " + std::to_string(now_) + " s (" +
                       std::to_string(patience) +
                       " events in 10 us); raise [hard] pair_elastic_speed or wall_elastic_speed");
  }
}

}  // namespace shakedown
