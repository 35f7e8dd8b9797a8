// SPDX-License-Identifier: MIT
// When grains meet the two walls across one axis: the end walls of a swinging box, or side walls where
// something sets them in motion as the grains see it. A kick on the box changes the wall time of every grain,
// so only lower bounds are kept: all of them are renewed after a kick in one vectorised sweep, and an exact
// root is sought for the earliest grain alone.
//
// In large dampers even that sweep would cost O(N) a kick. There a window is opened: with the box on its
// present arc, displaced by at most `slack`, most grains cannot reach a wall before the window ends. They
// sleep; only the others are swept. Kicks move the box off the arc by at most sum |dV| (end of window - now);
// when that exceeds the slack, or time runs out, a new window is opened. Windows are as long as makes the
// sweeps over all grains and over the watched ones cost the same.
//
// On its spring alone the box keeps to that: what a kick adds is the jump times the time at most. Where other
// forces act, each piece of its motion and each kick may bring accelerations of their own. There everything
// allows for an acceleration a little above the one at the start of the window, and a piece that exceeds it
// ends the window.
//
// Nor are the watched swept at every kick: their bounds allow for kicks that add up to a `budget` of
// velocity, (gap rate - budget) in place of the gap's rate. A kick within it renews the bounds of those alone
// whose exact root was known; the budget is as large as makes sweeps cost as much as the refinements that its
// caution adds.
#pragma once
#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "box_motion.hpp"
#include "lanes.hpp"
#include "smallest_tree.hpp"
#include "wall_root.hpp"

namespace shakedown {

/// What a grain meets at a wall. Capture and escape are the edges of an attraction's square well.
enum class Meeting : std::int8_t { none, touch, capture, escape };

class EndWalls {
 public:
  /// What is known of a grain along the axis: straight flight x + v (t - time).
  struct Flight {
    double x, v, time;
  };

  struct Next {
    double time = never;
    int grain = -1;
    int side = 0;                     ///< +1 or -1
    Meeting meeting = Meeting::none;  ///< none: `time` is a lower bound, to be refined
  };

  /// The walls at one moment.
  struct Now {
    double time;
    BoxMotion::Point point;
    double top_acceleration;  ///< bound of the walls' acceleration on their present piece, m/s^2
    double top_speed;         ///< m/s, a scale
    bool on_spring_alone;  ///< whatever comes, a kick strays from the arc by its jump times the time at most
  };
  template <class Motion>
  static Now now(const Motion& motion, double time) {
    return {time, motion.at(time), motion.top_acceleration(), motion.top_speed(),
            std::is_same_v<Motion, BoxMotion>};
  }

  /// `room` is half the inner length less each grain's radius, m; `range`: how far an attraction of the walls
  /// reaches, m (0: none).
  EndWalls(std::vector<double> room, bool always_watch_all, double range = 0);

  /// Opens a window. `flight_of(i)` gives each grain's flight.
  template <class FlightOf>
  void open(const Now& now, FlightOf&& flight_of);

  /// Grain i flies anew from now on; its bound is renewed by a kick that follows at once.
  void grain_flies(int i, const Flight& flight, const Now& now);
  /// Grain i flies anew from now on.
  void grain_changed(int i, const Flight& flight, const Now& now);
  /// The walls were kicked now: their motion goes on from there with a velocity jump of `jump` (0: only their
  /// bounds changed).
  void kicked(const Now& now, double jump);
  /// Grain i has entered (or left) the well of the wall on this side.
  void set_inside(int i, int side, bool inside);
  bool is_inside(int i, int side) const {
    return range_ > 0 && inside_[static_cast<std::size_t>(2 * i + (side > 0))] != 0;
  }
  /// A meeting of grain i turned out receding: look again a little later.
  void put_off(int i, double until);
  /// The time at which a new window must be opened.
  double window_end() const { return window_end_; }

  /// Earliest known meeting or bound.
  const Next& next() const { return next_; }
  /// Replaces the bound of next().grain by a sharper one or by its exact root; `limit`: time of the next
  /// other event.
  template <class Motion>
  void refine(const Motion& motion, double limit);

  double deepest_overlap() const { return -smallest_gap_; }
  std::size_t watched() const { return count_; }
  double bytes_per_grain() const {
    return room_.empty() ? 0 : 6 * sizeof(double) + 2 * sizeof(std::int32_t) + 2;
  }

 private:
  struct Root {
    double time = never;
    int side = 0;
    Meeting meeting = Meeting::none;
  };

  void find_next();
  void bound_all(const Now& now);
  void sweep(const Now& now);
  double bound_of(int grain, const Flight& flight, double room, const Now& now) const;
  /// The acceleration that bounds of times allow for.
  double top_in_window(const Now& now) const { return std::max(window_top_, now.top_acceleration); }
  bool can_sleep(const Flight& flight, double room, const Now& now) const;
  void watch(int i, const Flight& flight);
  /// Takes note of a new flight; false when the grain sleeps on.
  bool watch_changed(int i, const Flight& flight, const Now& now);
  void start_window(const Now& now);
  Root exact_root(const BoxMotion& box, const Now& now, int grain, const Flight& flight, double room,
                  double horizon) const;
  template <class Motion>
  Root exact_root(const Motion& motion, const Now& now, int grain, const Flight& flight, double room,
                  double horizon) const;

  bool watch_all_;
  double range_;
  std::vector<double> room_;        // of every grain
  std::vector<std::int32_t> slot_;  // of every grain: its place among the watched, -1 asleep
  // of every grain and side: in the well of that wall; empty without attraction
  std::vector<std::int8_t> inside_;
  // The watched grains, dense.
  std::size_t count_ = 0;
  AlignedVector<double> x_, v_, time_, room_of_slot_;
  SmallestTree bound_;
  std::vector<std::int32_t> grain_;
  std::vector<std::int8_t> side_;
  std::vector<Meeting> meeting_;  // none: bound_ is a lower bound
  Next next_;
  double window_start_ = 0, window_end_ = never, slack_ = never;
  double window_top_ = 0;          // m/s^2, that everything in this window allows for; 0: on the spring alone
  bool outgrown_ = false;          // by a later piece: that was no fault of the window's length
  double planned_ = 0;             // length of a window, s; adapted
  double drift_ = 0, jumps_ = 0;   // of this window: bound of the box's displacement off its arc, sum of |dV|
  double jump_rate_ = 0;           // sum of |dV| a second, of past windows
  double budget_ = 0, used_ = 0;   // m/s, of kicks that the bounds allow for, and that came since
  std::vector<std::int32_t> due_;  // slots whose bound a kick ends: exact roots, new flights
  std::int64_t kicks_ = 0, refined_ = 0;  // since the last sweep
  double swept_ = 0;                      // bounds renewed in this window
  double smallest_gap_ = 0;
};

inline bool EndWalls::can_sleep(const Flight& flight, double room, const Now& now) const {
  const double h = window_end_ - now.time;
  const double apart = now.point.x - (flight.x + flight.v * (now.time - flight.time)),
               rate = now.point.v - flight.v;
  const double curved = top_in_window(now) * h * h / 2, margin = slack_ + range_;
  // The bound is concave in time: it is lowest at one of the window's ends.
  const double upper = room + apart, lower = room - apart;
  return std::min(upper, upper + rate * h - curved) > margin &&
         std::min(lower, lower - rate * h - curved) > margin;
}

template <class FlightOf>
void EndWalls::open(const Now& now, FlightOf&& flight_of) {
  start_window(now);
  count_ = 0;
  for (std::size_t i = 0; i < room_.size(); ++i) {
    const Flight flight = flight_of(static_cast<int>(i));
    slot_[i] = -1;
    if (watch_all_ || !can_sleep(flight, room_[i], now)) watch(static_cast<int>(i), flight);
  }
  sweep(now);
}

template <class Motion>
void EndWalls::refine(const Motion& motion, double limit) {
  const int grain = next_.grain;
  const std::size_t k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(grain)]);
  const Flight flight{x_[k], v_[k], time_[k]};
  const double room = room_of_slot_[k];
  // A new bound from here is cheap; the root is sought only when the bound stays before the next event.
  const Now then = now(motion, bound_[k]);
  const double sharper = bound_of(grain, flight, room, then);
  if (sharper > limit) {
    bound_.set(k, sharper);
  } else {
    const Root root = exact_root(motion, then, grain, flight, room, limit);
    bound_.set(k, root.time);
    side_[k] = static_cast<std::int8_t>(root.side);
    meeting_[k] = root.meeting;
    if (!watch_all_) due_.push_back(static_cast<std::int32_t>(k));
  }
  ++refined_;
  find_next();
}

/// Any motion with a bound on its acceleration: steps that cannot overshoot, which near the root converge
/// like Newton's. No root is missed, because every stretch stepped over is proved free of one; what lies
/// beyond the horizon is left for later.
template <class Motion>
EndWalls::Root EndWalls::exact_root(const Motion& motion, const Now& now, int grain, const Flight& flight,
                                    double room, double horizon) const {
  const double top = now.top_acceleration, from = now.time;
  const double end = std::min({motion.valid_until(), std::max(horizon, from + 1e-9), from + 0.1});
  Root first{end, 0, Meeting::none};
  const auto search = [&](int side, double level, int direction, Meeting meeting) {
    // Looks for direction * (gap - level) falling through zero.
    double t = from;
    for (int iteration = 0; iteration < 10000 && t < first.time; ++iteration) {
      const BoxMotion::Point wall = motion.at(t);
      const double x = flight.x + flight.v * (t - flight.time);
      const double gap = direction * (room + side * (wall.x - x) - level),
                   rate = direction * side * (wall.v - flight.v);
      const double noise = 0x1p-52 * (room + std::abs(wall.x) + std::abs(x));
      const double step = earliest_possible_root(gap, rate, top);
      if ((gap <= noise && rate < 0) || step <= 2e-16 * t) {
        first = {t, side, meeting};
        return;
      }
      t += step;
    }
  };
  for (const int side : {1, -1}) {
    const bool inside = is_inside(grain, side);
    if (range_ > 0 && !inside)
      search(side, range_, 1, Meeting::capture);
    else
      search(side, 0, 1, Meeting::touch);
    if (inside) search(side, range_, -1, Meeting::escape);
  }
  return first;
}

}  // namespace shakedown
