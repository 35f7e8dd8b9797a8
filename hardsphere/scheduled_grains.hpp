// SPDX-License-Identifier: MIT
// Systems of many grains have this in common, however they find partners: one line a grain, and a calendar
// with the next event of each.
#pragma once
#include "calendar_queue.hpp"
#include "grain_lines.hpp"

namespace shakedown {

/// The part of `Grains` (event_loop.hpp says what each member does) that CellLists and CellCrossings share.
class ScheduledGrains {
 public:
  using Next = CalendarQueue::Next;

  int size() const { return static_cast<int>(lines_.size()); }  ///< number of grains
  /// Returns the flight that grain i is on: place, m, and velocity, m/s, at its own time, s.
  Flight3 flight(int i) const { return lines_.flight(static_cast<std::size_t>(i)); }
  /// Gives a grain its flight after an impact; what was predicted with it is stale.
  void set_flight(int i, const Flight3& flight) {
    move_to(i, flight);
    ++lines_[static_cast<std::size_t>(i)].count;
  }
  /// Brings a grain to another point of the flight it is on.
  void move_to(int i, const Flight3& flight) { lines_.move_to(static_cast<std::size_t>(i), flight); }
  /// Must not be called: square wells need the table of pairs that AllPairs keeps.
  void set_bond(int, int, bool) { EXPECT(false && "wells need AllPairs"); }
  int bonds() const { return 0; }
  double radius(int i) const { return lines_.radius(static_cast<std::size_t>(i)); }
  double mass(int i) const { return lines_.mass(static_cast<std::size_t>(i)); }
  bool is_stale(const GrainEvent& event) const {
    return event.partner >= 0 && lines_[static_cast<std::size_t>(event.partner)].count != event.partner_count;
  }
  GrainSums sums(double t) const { return lines_.sums(t); }
  double deepest_overlap() const { return lines_.deepest_overlap(); }

 protected:
  ScheduledGrains(const State& state, const std::array<double, 3>& extent)
      : lines_(state, extent), queue_(state.size()), prefetches_(state.size() > fits_in_cache) {}

  /// Returns the earliest event. `prefetch(i, days)` is told of grains whose turn comes in so many days of
  /// the calendar, in systems too large for the cache.
  template <std::size_t Looks, class Prefetch>
  Next next_event(const std::array<int, Looks>& days_ahead, const Prefetch& prefetch) {
    return prefetches_ ? queue_.next(days_ahead, prefetch) : queue_.next();
  }

  /// Predicts every grain and plans the calendar's days by the mean wait.
  template <class Predict>
  void plan_all(const Predict& predict) {
    double sum = 0, count = 0, now = 0;
    for (int i = 0; i < size(); ++i) {
      predict(i);
      now = lines_[static_cast<std::size_t>(i)].time;
      if (const double wait = queue_.time(i) - now; wait < never) sum += wait, ++count;
    }
    if (sum > 0) queue_.plan(now, count * count / sum);
  }

  GrainLines lines_;
  CalendarQueue queue_;

 private:
  bool prefetches_;
};

}  // namespace shakedown
