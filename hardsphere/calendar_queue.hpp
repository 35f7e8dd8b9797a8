// SPDX-License-Identifier: MIT
// Event queue whose cost does not grow with the number of grains: a calendar (Brown 1988; for event-driven
// dynamics Paul 2007, J. Comput. Phys. 221, 615). Each grain has one date. A year is cut into days, a day
// holds a third of a date, unsorted; dates beyond the year wait in one list that is looked through once a
// year. The length of a day follows the density of events.
//
// Which days are empty and where a date stands in its list is as good as random, and a branch taken wrong
// costs more than the rest of the work. So the next day with a date is found in words of bits, one a day, and
// dates enter and leave lists without a branch: a list ends at a record that belongs to no grain, and the
// first date of a day has the day in place of a predecessor.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "lanes.hpp"
#include "wall_root.hpp"

namespace shakedown {

class CalendarQueue {
 public:
  struct Next {
    double time;
    int grain;
  };

  explicit CalendarQueue(std::size_t grains) : dates_(grains + 1), end_(static_cast<std::int32_t>(grains)) {
    std::size_t days = 64;
    while (days < 4 * grains) days *= 2;
    first_.assign(days + 1, end_);
    dated_.assign(days / 64 + 1, 0);
    set_day_length(1.0);
  }

  /// Gives grain i a new date (or `never`).
  void schedule(int i, double time) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (dates_[k].time < never) remove(k);
    dates_[k].time = time;
    if (time < never) insert(k);
    if (cached_ == i) cached_ = none;
    if (cached_ != none && time < this->time(cached_)) cached_ = i;
  }

  /// Returns the earliest date; grain -1 when there is none. `tell(i, days)` is told of grains whose dates
  /// come up in each of these numbers of days (a third as many events), to bring near what they need.
  template <std::size_t Looks, class Ahead>
  Next next(const std::array<int, Looks>& days_ahead, Ahead&& tell) {
    if (cached_ == none) find(days_ahead, tell);
    return cached_ == none ? Next{never, -1} : Next{time(cached_), cached_};
  }

  /// Returns the earliest date; grain -1 when there is none.
  Next next() {
    return next(std::array<int, 0>{}, [](int, int) {});
  }

  /// Brings the date of grain i near the processor; nothing changes.
  void prefetch(int i) const { __builtin_prefetch(&dates_[static_cast<std::size_t>(i)]); }

  /// Sets the length of a day for this many events a second and begins the year at `now`, s; dates may be
  /// scheduled already.
  void plan(double now, double events_per_second) {
    cached_ = none;
    rebuild(now, dates_a_day / events_per_second);
  }

  /// Returns the date of grain i, s; `never` where it has none.
  double time(int i) const { return dates_[static_cast<std::size_t>(i)].time; }
  std::size_t bytes() const {
    return dates_.size() * sizeof(Date) + first_.size() * sizeof(std::int32_t) +
           dated_.size() * sizeof(std::uint64_t);
  }

 private:
  static constexpr std::int32_t none = -1;
  static constexpr double dates_a_day = 0.35;
  /// A grain's date and its neighbours in the list of the day.
  struct Date {
    double time = never;
    std::int32_t next = none, previous = none;  ///< of the first date of a day, `previous` is ~day
  };
  /// Returns the number of days in a year; the list of that number holds what lies beyond.
  std::size_t days() const { return first_.size() - 1; }

  /// Dates without end at one moment (a grain between walls that leave it no play) would make days so short
  /// that no number counts them.
  static constexpr double shortest_day = 1e-15;  // s

  /// Sets the length of a day, s, to shortest_day at least.
  void set_day_length(double length) {
    length = std::max(length, shortest_day);
    day_length_ = length;
    per_second_ = 1 / length;
  }

  /// Enters date k into the list of its day, never one before today.
  void insert(std::size_t k) {
    // A date that rounding has put into the past is filed under today.
    Date& date = dates_[k];
    const double day = std::clamp((date.time - year_start_) * per_second_, 0.0, static_cast<double>(days()));
    const std::size_t d = std::max(static_cast<std::size_t>(static_cast<std::int64_t>(day)), today_);
    date.previous = ~static_cast<std::int32_t>(d);
    date.next = first_[d];
    dates_[static_cast<std::size_t>(date.next)].previous = static_cast<std::int32_t>(k);
    first_[d] = static_cast<std::int32_t>(k);
    dated_[d / 64] |= std::uint64_t{1} << d % 64;
  }

  /// Takes date k out of its list.
  void remove(std::size_t k) {
    const Date& date = dates_[k];
    const bool is_first = date.previous < 0;
    const std::size_t day = static_cast<std::size_t>(~date.previous & (date.previous >> 31)),
                      before = static_cast<std::size_t>(date.previous);
    std::int32_t* const of_day = &first_[day];
    std::int32_t* const of_date = &dates_[is_first ? 0 : before].next;
    *(is_first ? of_day : of_date) = date.next;
    dates_[static_cast<std::size_t>(date.next)].previous = date.previous;
    dated_[day / 64] &= ~(std::uint64_t{is_first && date.next == end_} << day % 64);
  }

  /// Returns the first day from `day` on that has a date, or days(), the list beyond the year.
  std::size_t next_dated(std::size_t day) const {
    std::size_t word = day / 64;
    std::uint64_t bits = dated_[word] & (~std::uint64_t{0} << day % 64);
    while (bits == 0 && word < days() / 64) bits = dated_[++word];
    return bits == 0 ? days() : word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
  }

  /// Finds the earliest date and keeps it in cached_, which stays `none` when there is none; begins years as
  /// needed.
  template <std::size_t Looks, class Ahead>
  void find(const std::array<int, Looks>& days_ahead, Ahead&& tell) {
    for (;;) {
      const std::size_t day = std::min(next_dated(today_), days());
      for (const int ahead : days_ahead) tell_of(ahead, day, tell);
      today_ = day;
      if (today_ == days() && !new_year()) return;
      ++looks_;
      for (std::int32_t i = first_[today_]; i != end_; i = dates_[static_cast<std::size_t>(i)].next) {
        ++looks_;
        if (cached_ == none || time(i) < time(cached_) || (time(i) == time(cached_) && i < cached_))
          cached_ = i;
      }
      if (cached_ != none) {
        ++found_;
        if (looks_ > 8 * found_ + 64 * static_cast<std::int64_t>(days())) retune();
        return;
      }
    }
  }

  /// Calls `tell` for each date that comes within `days_ahead` when today moves on to `day`.
  template <class Ahead>
  void tell_of(int days_ahead, std::size_t day, Ahead&& tell) const {
    const std::size_t in_sight = std::min(day + static_cast<std::size_t>(days_ahead), days() - 1);
    for (std::size_t d = next_dated(today_ + static_cast<std::size_t>(days_ahead) + 1); d <= in_sight;
         d = next_dated(d + 1))
      tell(first_[d], days_ahead);
  }

  /// Moves the waiting dates into a new year; false when there are none.
  bool new_year() {
    double earliest = never;
    for (std::int32_t i = first_[days()]; i != end_; i = dates_[static_cast<std::size_t>(i)].next)
      earliest = std::min(earliest, time(i));
    if (earliest == never) return false;
    // Few dates a day keep its list short; with too few of them more dates lie beyond the year.
    const double events_per_day = static_cast<double>(found_) / static_cast<double>(days());
    const bool tune = events_per_day > 2 * dates_a_day || events_per_day < dates_a_day / 2;
    rebuild(earliest,
            tune ? day_length_ * std::clamp(dates_a_day / std::max(events_per_day, 1e-3), 0.01, 100.0)
                 : day_length_);
    return true;
  }

  /// Today is crowded far beyond the plan: shorten the days now.
  void retune() {
    const double now = time(cached_);
    rebuild(now, day_length_ * 0.25);
  }

  /// Begins a year at `start` (s) with days of this length (s) and files every date anew.
  void rebuild(double start, double day_length) {
    set_day_length(day_length);
    year_start_ = start;
    today_ = 0;
    found_ = looks_ = 0;
    std::fill(first_.begin(), first_.end(), end_);
    std::fill(dated_.begin(), dated_.end(), std::uint64_t{0});
    for (std::size_t k = 0; k + 1 < dates_.size(); ++k)
      if (dates_[k].time < never) insert(k);
  }

  AlignedVector<Date> dates_;  // the last one is the end of every list
  std::int32_t end_;
  AlignedVector<std::int32_t> first_;   // of each day; the last entry is the list of dates beyond the year
  AlignedVector<std::uint64_t> dated_;  // a bit a day: whether it has dates
  double day_length_ = 1, per_second_ = 1, year_start_ = 0;
  std::size_t today_ = 0;
  std::int64_t found_ = 0, looks_ = 0;
  std::int32_t cached_ = none;
};

}  // namespace shakedown
