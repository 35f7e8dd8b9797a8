// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: what moving walls are told and asked.
#pragma once
#include "event_loop.hpp"

namespace shakedown {

template <class Grains, class Motion>
DrivenWalls EventLoop<Grains, Motion>::walls_across(int axis) const {
  if constexpr (driven)
    return {&box_, &frame_, axis, arc_curvature_, release_x_};
  else
    return {};
}

template <class Grains, class Motion>
EndWalls::Now EventLoop<Grains, Motion>::end_walls_now() {
  if constexpr (driven)
    return EndWalls::now(walls_across(0), now_);
  else
    return {now_, box_now(), box_.top_acceleration(), box_.top_speed(), true};
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
    if (walls(axis).window_end() <= now_ || events_ == 0)
      walls(axis).open(EndWalls::now(walls_across(axis), now_), along(axis));
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
void EventLoop<Grains, Motion>::wall_event(int axis, EndWalls& walls, const EndWalls::Next& next) {
  meet_wall(axis, walls, next);
  write_down(EventKind::wall, next.grain, axis, next.side, next.meeting);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::meet_wall(int axis, EndWalls& walls, const EndWalls::Next& next) {
  if constexpr (driven)
    if (next.meeting != Meeting::touch) return wall_well(next.grain, axis, next.side, next.meeting, walls);
  if (axis == 0)
    end_impact(next.grain, next.side);
  else
    moving_side_impact(next.grain, axis, next.side);
}

/// Tells the walls of a grain's new flight. A kick of the box that follows renews every bound of the end
/// walls, also this grain's.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::after(int i, bool kick_follows) {
  if (scripted || !has_walls_) return;
  const Flight3 flight = grains_.flight(i);
  const EndWalls::Flight along{flight.x[0], flight.v[0], flight.time};
  if (kick_follows)
    end_walls_.grain_flies(i, along, end_walls_now());
  else
    end_walls_.grain_changed(i, along, end_walls_now());
  if constexpr (driven)
    for (int axis = 1; axis <= static_cast<int>(side_walls_.size()); ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      walls(axis).grain_changed(i, {flight.x[k], flight.v[k], flight.time},
                                EndWalls::now(walls_across(axis), now_));
    }
}

}  // namespace shakedown
