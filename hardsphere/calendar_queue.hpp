// SPDX-License-Identifier: MIT
// Event queue whose cost does not grow with the number of grains: a calendar (Brown 1988; for event-driven dynamics Paul 2007,
// J. Comput. Phys. 221, 615). Each grain has one date. A year is cut into days, a day holds about one date, unsorted; dates beyond the
// year wait in one list that is looked through once a year. The length of a day follows the density of events.
#pragma once
#include <algorithm>
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

  explicit CalendarQueue(std::size_t grains) : dates_(grains) {
    std::size_t days = 64;
    while (days < 4 * grains) days *= 2;
    first_.assign(days + 1, none);
    set_day_length(1.0);
  }

  /// Gives grain i a new date (or `never`).
  void schedule(int i, double time) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (dates_[k].day != none) remove(k);
    dates_[k].time = time;
    if (time < never) insert(k);
    if (cached_ == i) cached_ = none;
    if (cached_ != none && time < this->time(cached_)) cached_ = i;
  }

  /// The earliest date; grain -1 when there is none. `tell(i, days)` is told of grains whose dates come up in about that many days, half
  /// as many events: time to bring what they need near.
  template <class Ahead>
  Next next(Ahead&& tell) {
    if (cached_ == none) find(tell);
    return cached_ == none ? Next{never, -1} : Next{time(cached_), cached_};
  }

  Next next() {
    return next([](int, int) {});
  }

  static constexpr int far_ahead = 8, ahead = 4;  ///< days
  void prefetch(int i) const { __builtin_prefetch(&dates_[static_cast<std::size_t>(i)]); }

  /// Sets the length of a day for this many events a second; dates may be scheduled already.
  void plan(double now, double events_per_second) {
    cached_ = none;
    rebuild(now, 0.5 / events_per_second);
  }

  double time(int i) const { return dates_[static_cast<std::size_t>(i)].time; }
  std::size_t bytes() const { return dates_.size() * sizeof(Date) + first_.size() * sizeof(std::int32_t); }

 private:
  static constexpr std::int32_t none = -1;
  /// A grain's date and its neighbours in the list of the day.
  struct Date {
    double time = never;
    std::int32_t next = none, previous = none, day = none;
  };
  std::size_t days() const { return first_.size() - 1; }

  void set_day_length(double length) {
    day_length_ = length;
    per_second_ = 1 / length;
  }

  void insert(std::size_t k) {
    // Dates of the past (of rounding) belong to today.
    Date& date = dates_[k];
    const double day = std::max(std::floor((date.time - year_start_) * per_second_), static_cast<double>(today_));
    const std::size_t d = day < static_cast<double>(days()) ? static_cast<std::size_t>(day) : days();
    date.day = static_cast<std::int32_t>(d);
    date.previous = none;
    date.next = first_[d];
    if (date.next != none) dates_[static_cast<std::size_t>(date.next)].previous = static_cast<std::int32_t>(k);
    first_[d] = static_cast<std::int32_t>(k);
  }

  void remove(std::size_t k) {
    Date& date = dates_[k];
    if (date.previous != none) dates_[static_cast<std::size_t>(date.previous)].next = date.next;
    else first_[static_cast<std::size_t>(date.day)] = date.next;
    if (date.next != none) dates_[static_cast<std::size_t>(date.next)].previous = date.previous;
    date.day = none;
  }

  template <class Ahead>
  void find(Ahead&& tell) {
    for (;; ++today_, ++days_passed_) {
      for (const int days_ahead : {far_ahead, ahead})
        if (today_ + static_cast<std::size_t>(days_ahead) < days())
          if (const std::int32_t i = first_[today_ + static_cast<std::size_t>(days_ahead)]; i != none) tell(i, days_ahead);
      if (today_ == days() && !new_year()) return;
      ++looks_;
      for (std::int32_t i = first_[today_]; i != none; i = dates_[static_cast<std::size_t>(i)].next) {
        ++looks_;
        if (cached_ == none || time(i) < time(cached_) || (time(i) == time(cached_) && i < cached_)) cached_ = i;
      }
      if (cached_ != none) {
        ++found_;
        if (looks_ > 8 * found_ + 64 * static_cast<std::int64_t>(days())) retune();
        return;
      }
    }
  }

  /// Moves the waiting dates into a new year; false when there are none.
  bool new_year() {
    double earliest = never;
    for (std::int32_t i = first_[days()]; i != none; i = dates_[static_cast<std::size_t>(i)].next)
      earliest = std::min(earliest, time(i));
    if (earliest == never) return false;
    // About one event in two days keeps both the empty days and the crowded ones cheap.
    const double events_per_day = static_cast<double>(found_) / static_cast<double>(std::max<std::int64_t>(1, days_passed_));
    const bool tune = days_passed_ >= static_cast<std::int64_t>(days()) / 2 && (events_per_day > 1.0 || events_per_day < 0.2);
    rebuild(earliest, tune ? day_length_ * std::clamp(0.5 / std::max(events_per_day, 1e-3), 0.01, 100.0) : day_length_);
    return true;
  }

  /// Today is crowded far beyond the plan: shorten the days now.
  void retune() {
    const double now = time(cached_);
    rebuild(now, day_length_ * 0.25);
  }

  void rebuild(double start, double day_length) {
    set_day_length(day_length);
    year_start_ = start;
    today_ = 0;
    days_passed_ = found_ = looks_ = 0;
    std::fill(first_.begin(), first_.end(), none);
    for (std::size_t k = 0; k < dates_.size(); ++k)
      if (dates_[k].day != none) insert(k);
  }

  AlignedVector<Date> dates_;
  AlignedVector<std::int32_t> first_;  // of each day; the last entry is the list of dates beyond the year
  double day_length_ = 1, per_second_ = 1, year_start_ = 0;
  std::size_t today_ = 0;
  std::int64_t found_ = 0, looks_ = 0, days_passed_ = 0;
  std::int32_t cached_ = none;
};

}  // namespace shakedown
