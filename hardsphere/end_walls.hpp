// SPDX-License-Identifier: MIT
// When grains meet the end walls. A kick on the box changes the wall time of every grain, so only lower bounds are kept: all of
// them are renewed after a kick in one vectorised sweep, and an exact root is sought for the earliest grain alone.
//
// In large dampers even that sweep would cost O(N) a kick. There a window is opened: with the box on its present arc, displaced by
// at most `slack`, most grains cannot reach a wall before the window ends. They sleep; only the others are swept. Kicks move the box
// off the arc by at most sum |dV| (end of window - now); when that exceeds the slack, or time runs out, a new window is opened.
// Windows are as long as makes the sweeps over all grains (one a window) and over the watched ones (one a kick) cost the same; a
// kick then costs O(sqrt N) with a small factor.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "box_motion.hpp"
#include "lanes.hpp"
#include "wall_root.hpp"

namespace shakedown {

class EndWalls {
 public:
  /// What is known of a grain along x: straight flight x + v (t - time).
  struct Flight {
    double x, v, time;
  };

  struct Next {
    double time = never;
    int grain = -1;
    int side = 0;        ///< +1 or -1 when `certain`
    bool certain = false;  ///< an exact root; otherwise a lower bound to be refined
  };

  /// `room` is the half length of the box less each grain's radius, m.
  EndWalls(std::vector<double> room, bool always_watch_all);

  /// Opens the first window. `flight_of(i)` gives each grain's flight.
  template <class FlightOf>
  void open(double now, const BoxMotion& box, FlightOf&& flight_of);

  /// Grain i flies anew from `now` on.
  void grain_changed(int i, const Flight& flight, double now, BoxMotion::Point box_now, double top_acceleration);
  /// The box was kicked at `now`; its motion restarted there with a velocity jump of `jump`.
  void box_kicked(double now, const BoxMotion& box, double jump);
  /// The time at which a new window must be opened.
  double window_end() const { return window_end_; }

  /// Earliest known wall time, exact or bound.
  const Next& next() const { return next_; }
  /// Replaces the bound of next().grain by a sharper one or by its exact root; `limit`: time of the next other event.
  void refine(const BoxMotion& box, double limit);

  double deepest_overlap() const { return -smallest_gap_; }
  std::size_t watched() const { return count_; }
  double bytes_per_grain() const { return room_.empty() ? 0 : 6 * sizeof(double) + 2 * sizeof(std::int32_t) + 1; }

 private:
  void find_next();
  void bound_all(double now, const BoxMotion& box);
  double bound_of(const Flight& flight, double room, double now, BoxMotion::Point point, double top_acceleration) const;
  bool can_sleep(const Flight& flight, double room, double now, BoxMotion::Point point, double top_acceleration) const;
  void watch(int i, const Flight& flight);
  void drop(std::size_t slot);
  void start_window(double now, const BoxMotion& box);

  bool watch_all_;
  std::vector<double> room_;         // of every grain
  std::vector<std::int32_t> slot_;   // of every grain: its place among the watched, -1 asleep
  // The watched grains, dense.
  std::size_t count_ = 0;
  AlignedVector<double> x_, v_, time_, room_of_slot_, bound_;
  std::vector<std::int32_t> grain_;
  std::vector<std::int8_t> side_;    // 0: bound_ is a lower bound
  Next next_;
  double window_start_ = 0, window_end_ = never, slack_ = never;
  double planned_ = 0;               // length of a window, s; adapted
  double drift_ = 0, jumps_ = 0;     // of this window: bound of the box's displacement off its arc, sum of |dV|
  double jump_rate_ = 0;             // sum of |dV| a second, of past windows
  std::int64_t kicks_ = 0;           // in this window
  double smallest_gap_ = 0;
};

inline bool EndWalls::can_sleep(const Flight& flight, double room, double now, BoxMotion::Point point,
                                double top_acceleration) const {
  const double h = window_end_ - now;
  const double apart = point.x - (flight.x + flight.v * (now - flight.time)), rate = point.v - flight.v;
  const double curved = top_acceleration * h * h / 2;
  // The bound is concave in time: it is lowest at one of the window's ends.
  const double upper = room + apart, lower = room - apart;
  return std::min(upper, upper + rate * h - curved) > slack_ && std::min(lower, lower - rate * h - curved) > slack_;
}

template <class FlightOf>
void EndWalls::open(double now, const BoxMotion& box, FlightOf&& flight_of) {
  start_window(now, box);
  const BoxMotion::Point point = box.at(now);
  const double top_acceleration = box.top_acceleration();
  count_ = 0;
  for (std::size_t i = 0; i < room_.size(); ++i) {
    const Flight flight = flight_of(static_cast<int>(i));
    slot_[i] = -1;
    if (watch_all_ || !can_sleep(flight, room_[i], now, point, top_acceleration)) watch(static_cast<int>(i), flight);
  }
  bound_all(now, box);
}

}  // namespace shakedown
