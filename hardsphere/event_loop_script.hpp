// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: events written down, and executed again from what was written.
#pragma once
#include <bit>

#include "event_loop.hpp"
#include "fnv.hpp"

namespace shakedown {

/// Executes the impact with the same code that executed it at first; only that it happens, and when, is taken
/// from the log.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::execute(const LoggedEvent& event) {
  static_assert(scripted);
  now_ = event.time;
  ++events_;
  switch (event.kind) {
    case EventKind::pair:
      if (event.meeting != Meeting::touch) return pair_well(event.grain, event.partner, event.meeting);
      return pair_impact(event.grain, event.partner);
    case EventKind::wall:
      if (event.partner > 0 && side_walls_.empty())
        return fixed_side_impact(event.grain, side_wall(event.partner, event.side));
      return meet_wall(event.partner, walls(event.partner),
                       {event.time, event.grain, event.side, event.meeting});
    case EventKind::new_anchor: {
      Flight3 flight = grains_.flight(event.grain);
      flight.advance(now_);
      return grains_.move_to(event.grain, flight);
    }
    case EventKind::grain_kick: return kick_grains();
    case EventKind::next_piece: return go_on();
  }
}

/// FNV-1a over the bits of all flights, spins and the box.
template <class Grains, class Motion>
std::uint64_t EventLoop<Grains, Motion>::digest() const {
  std::uint64_t hash = fnv_start;
  const auto mix = [&hash](double value) { hash = fnv_step(hash, std::bit_cast<std::uint64_t>(value)); };
  for (int i = 0; i < grains_.size(); ++i) {
    const Flight3 flight = grains_.flight(i);
    for (std::size_t axis = 0; axis < 3; ++axis) mix(flight.x[axis]), mix(flight.v[axis]);
    mix(flight.time);
  }
  for (const Vec3& spin : spin_)
    for (const double value : spin) mix(value);
  mix(box_.x()), mix(box_.v()), mix(box_.time());
  return hash;
}

}  // namespace shakedown
