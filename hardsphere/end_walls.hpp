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
#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "box_motion.hpp"
#include "lanes.hpp"
#include "smallest_tree.hpp"
#include "wall_root.hpp"

namespace shakedown {

/// What happens to a grain at a wall or at another grain: a touch, or the edge of an attraction's square well
/// from outside (capture) or from within (escape).
enum class Meeting : std::int8_t { none, touch, capture, escape };

class EndWalls {
 public:
  /// A grain along the axis, in straight flight x + v (t - time); m, m/s, s.
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
  /// Returns the walls of this motion at `time`, s, which must lie on its present piece.
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
  /// Grain i flies anew from now on. `may_fly_on`: what is known of it stays where its velocity along the
  /// axis did, and nothing is due now.
  void grain_changed(int i, const Flight& flight, const Now& now, bool may_fly_on = false);
  /// The walls were kicked now: their motion goes on from there with a velocity jump of `jump` (0: only their
  /// bounds changed).
  void kicked(const Now& now, double jump);
  /// Grain i has entered (or left) the well of the wall on this side.
  void set_inside(int i, int side, bool inside);
  bool is_inside(int i, int side) const {
    return range_ > 0 && inside_[static_cast<std::size_t>(2 * i + (side > 0))] != 0;
  }
  /// Looks for the next meeting of grain i from the time `until` (s) on, because the one predicted turned out
  /// receding.
  void put_off(int i, double until);
  /// Returns the time at which a new window must be opened, s.
  double window_end() const { return window_end_; }

  /// Returns the earliest known meeting or bound.
  const Next& next() const { return next_; }
  /// Replaces the bound of next().grain by a sharper one or by its exact root; `limit`: time of the next
  /// other event.
  template <class Motion>
  void refine(const Motion& motion, double limit);

  /// Returns how deep a watched grain was in a wall whenever all bounds were renewed, m; 0: never.
  double deepest_overlap() const { return -smallest_gap_; }
  std::size_t watched() const { return count_; }  ///< number of grains that are not asleep
  /// Returns the memory held for all grains, B.
  std::size_t bytes() const;

 private:
  class EarliestRoots;
  struct Root {
    double time = never;
    int side = 0;
    Meeting meeting = Meeting::none;
  };

  /// Finds the earliest meeting or bound of the watched.
  void find_next();
  /// Renews the bound of every watched grain, in vector lanes; sweep() also adapts the budget.
  void bound_all(const Now& now);
  void sweep(const Now& now);
  /// Returns a time, s, before which the grain meets nothing at these walls.
  double bound_of(int grain, const Flight& flight, double room, const Now& now) const;
  double bound_at_wells(int grain, double upper, double lower, double rate, double top) const;
  /// Returns the acceleration that bounds of times allow for, m/s^2.
  double top_in_window(const Now& now) const { return std::max(window_top_, now.top_acceleration); }
  /// Tells whether a grain cannot reach a wall before the window ends, with the slack allowed for.
  bool can_sleep(const Flight& flight, double room, const Now& now) const;
  double room_of(std::size_t i) const { return room_[equal_ ? 0 : i]; }
  /// Puts grain i among the watched.
  void watch(int i, const Flight& flight);
  /// Makes room for so many watched grains, no fewer than before.
  void make_room(std::size_t watched);
  void note_inside(std::size_t slot, int i);
  /// Takes note of a new flight; false when the grain sleeps on.
  bool watch_changed(int i, const Flight& flight, const Now& now);
  /// Begins a window with a length that makes sweeps over all grains and over the watched cost the same.
  void start_window(const Now& now);
  Root exact_root(const BoxMotion& box, const Now& now, int grain, const Flight& flight, double room,
                  double horizon) const;
  /// What a grain may meet next at a wall: where direction * (gap - level) falls through zero.
  struct Edge {
    int side;
    double level;  ///< m
    int direction;
    Meeting meeting;
    double bound;  ///< s from now, before which it cannot be met
  };
  struct Edges {
    std::array<Edge, 4> edge;
    std::size_t count = 0;
  };
  /// Returns what the grain may meet next at both walls, the one with the earliest bound first.
  Edges edges_ahead(const Now& now, int grain, const Flight& flight, double room) const;
  /// Returns the first meeting with walls that swing about `centre`, m, at `angular_frequency`, rad/s.
  Root harmonic_root(double centre, double angular_frequency, const Now& now, int grain, const Flight& flight,
                     double room) const;
  template <class Motion>
  Root exact_root(const Motion& motion, const Now& now, int grain, const Flight& flight, double room,
                  double horizon) const;

  bool watch_all_;
  double range_;
  std::vector<double> room_;  // of every grain; of the first where all are equal
  bool equal_ = true;
  std::vector<std::int32_t> slot_;  // of every grain: its place among the watched, -1 asleep
  // of every grain and side: in the well of that wall; empty without attraction
  std::vector<std::int8_t> inside_;
  // the same of the watched, 1 or 0, at the upper and at the lower wall
  std::array<AlignedVector<double>, 2> inside_of_slot_;
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
  for (std::size_t i = 0; i < slot_.size(); ++i) {
    const Flight flight = flight_of(static_cast<int>(i));
    slot_[i] = -1;
    if (watch_all_ || !can_sleep(flight, room_of(i), now)) watch(static_cast<int>(i), flight);
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

/// Finds the first root for any motion with a bound on its acceleration, by steps that cannot overshoot and
/// that converge like Newton's near the root. No root is missed, because every stretch stepped over is proved
/// free of one; what lies beyond the horizon is left for later.
template <class Motion>
EndWalls::Root EndWalls::exact_root(const Motion& motion, const Now& now, int grain, const Flight& flight,
                                    double room, double horizon) const {
  if constexpr (requires { motion.harmonic_centre(); })
    if (const std::optional<double> centre = motion.harmonic_centre()) {
      const Root root = harmonic_root(*centre, motion.angular_frequency(), now, grain, flight, room);
      return root.time <= motion.valid_until() ? root : Root{motion.valid_until(), 0, Meeting::none};
    }
  const double top = now.top_acceleration, from = now.time;
  const double end = std::min({motion.valid_until(), std::max(horizon, from + 1e-9), from + 0.1});
  Root first{end, 0, Meeting::none};
  const auto search = [&](const Edge& edge) {
    BoxMotion::Point wall = now.point;
    double t = from;
    for (int iteration = 0; iteration < 10000 && t < first.time; ++iteration) {
      if (iteration > 0) wall = motion.at(t);
      const double x = flight.x + flight.v * (t - flight.time);
      const double gap = edge.direction * (room + edge.side * (wall.x - x) - edge.level),
                   rate = edge.direction * edge.side * (wall.v - flight.v);
      const double noise = 0x1p-52 * (room + std::abs(wall.x) + std::abs(x));
      const double step = earliest_possible_root(gap, rate, top);
      if ((gap <= noise && rate < 0) || step <= 2e-16 * t) {
        first = {t, edge.side, edge.meeting};
        return;
      }
      t += step;
    }
  };
  const Edges ahead = edges_ahead(now, grain, flight, room);
  for (std::size_t k = 0; k < ahead.count; ++k) search(ahead.edge[k]);
  return first;
}

}  // namespace shakedown
