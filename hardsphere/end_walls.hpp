// SPDX-License-Identifier: MIT
// When grains meet the end walls. A kick on the box changes the wall time of every grain, so only lower bounds are kept: all of
// them are renewed after a kick in one vectorised sweep, and an exact root is sought for the earliest grain alone.
//
// In large dampers even that sweep would cost O(N) a kick. There a window is opened: with the box on its present arc, displaced by
// at most `slack`, most grains cannot reach a wall before the window ends. They sleep; only the others are swept. Kicks move the box
// off the arc by at most sum |dV| (end of window - now); when that exceeds the slack, or time runs out, a new window is opened.
#pragma once
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
  void grain_changed(int i, const Flight& flight, double now, const BoxMotion& box);
  /// The box was kicked at `now`; its motion restarted there with a velocity jump of `jump`.
  void box_kicked(double now, const BoxMotion& box, double jump);
  /// True when a new window must be opened before time t is passed.
  bool window_ends_by(double t) const { return t >= window_end_ || drift_ > slack_; }
  double window_end() const { return window_end_; }

  /// Earliest known wall time, exact or bound.
  const Next& next() const { return next_; }
  /// Replaces the bound of next().grain by a sharper one or by its exact root; `limit`: time of the next other event.
  void refine(const BoxMotion& box, double limit);

  double deepest_overlap() const { return -smallest_gap_; }
  std::size_t watched() const { return count_; }

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
  double window_end_ = never, slack_ = never, drift_ = 0;
  double reach_ = 0;                 // length over which a window is safe, m; adapted
  std::int64_t kicks_ = 0;           // in this window
  double smallest_gap_ = 0;
};

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
  find_next();
}

}  // namespace shakedown
