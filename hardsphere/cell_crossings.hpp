// SPDX-License-Identifier: MIT
// Grains of a periodic fluid of moderate density: cells little wider than a grain, no lists. A grain is
// tested against those in the 27 cells around it after an impact, and against those in the nine new ones when
// it crosses into the next cell. Its earliest impact is kept beyond the crossing, so that a crossing costs
// few tests. Beside CellLists at packing fraction 0.1: 2.7 crossings an impact of two tests each instead
// of 2.8 renewed lists, 14 pair tests an impact in all.
#pragma once
#include <vector>

#include "scheduled_grains.hpp"

namespace shakedown {

class CellCrossings : public ScheduledGrains {
 public:
  /// Tells whether this class can hold the state: the domain is three grains wide at least, the grains are
  /// equal, and they are not too few for so many cells.
  static bool can_hold(const State& state, const std::array<double, 3>& extent);
  /// `edge`: the least width of a cell in diameters, 0: the least possible.
  CellCrossings(const State& state, const std::array<double, 3>& extent, double edge = 0);

  /// Does nothing: a periodic cell has no side walls.
  void forget_side_walls() {}
  /// Returns time, s, and grain of the earliest event: an impact, or a crossing into another cell; grain -1
  /// when there is none.
  Next next() {
    return next_event(looks, [this](int i, int days) { prefetch(i, days); });
  }
  /// Returns what comes first to grain i: its crossing (its partner is then leaves_neighbourhood), or its
  /// impact.
  GrainEvent event(int i) const {
    const Place& place = place_[static_cast<std::size_t>(i)];
    if (place.crosses) return {queue_.time(i), leaves_neighbourhood, 0, Meeting::touch};
    return {place.pair_time, place.partner, place.partner_count, Meeting::touch};
  }
  /// Find the next event of one grain, of both grains of a pair, or of all, whose flights start now.
  void predict(int i);
  void predict(int i, int j) {
    predict(i);
    predict(j);
  }
  /// Finds the events of all, and plans the days of the calendar by them.
  void predict_all() {
    plan_all([this](int i) { predict(i); });
  }
  /// Grain i crosses into the next cell.
  void leave_neighbourhood(int i, double now);
  /// Vector from a to the nearest image of b.
  std::array<double, 3> separation(const Flight3& a, const Flight3& b) const;
  double bytes_per_grain() const;

 private:
  static constexpr std::array looks{12, 6};  ///< days ahead, at grains whose lines are to be brought near
  struct Place {
    double pair_time = never;
    std::int32_t partner = no_partner;
    std::uint32_t partner_count = 0;
    std::array<std::uint16_t, 3> cell{};
    std::uint8_t axis = 0;  ///< that will be crossed next
    bool crosses = false;   ///< before the earliest impact
  };
  using Others = std::array<std::int32_t, 512>;
  class Collector;
  /// This bit of a link to a grain says that another follows it in its cell.
  static constexpr std::int32_t has_next = 1 << 30;

  /// Returns the place of a cell in cell_first_.
  std::size_t index_of(const std::array<std::uint16_t, 3>& cell) const {
    return offset_[0][cell[0] + 1u] + offset_[1][cell[1] + 1u] + offset_[2][cell[2] + 1u];
  }
  /// Returns the offsets along an axis of the cells before, at and after a grain's own.
  const std::uint32_t* around(std::size_t i, std::size_t axis) const {
    return &offset_[axis][place_[i].cell[axis]];
  }
  void prefetch(int i, int days) const;
  void put_in_cell(std::size_t i);
  void take_from_cell(std::size_t i);
  /// Writes the grains of the 27 cells around grain i to `others`, filled up with i to a whole vector;
  /// returns how many they are.
  std::size_t collect_around(std::size_t i, Others& others) const;
  /// Writes those of the nine cells one step ahead along an axis, likewise.
  std::size_t collect_ahead(std::size_t i, std::size_t axis, int step, Others& others) const;
  /// Keeps the earliest impact of grain i, which was searched at `now`.
  void remember(std::size_t i, double now, const GrainLines::Touch& touch);
  /// Finds when grain i crosses into the next cell, and schedules that or its impact, whichever is earlier.
  void schedule(std::size_t i, const Flight3& anchor, double now);

  AlignedVector<Place> place_;
  AlignedVector<std::int32_t> cell_first_;
  std::array<int, 3> cells_{};
  std::array<double, 3> edge_{};
  // of a cell's index, per axis; one step beyond both ends wraps around, one more fills a vector
  std::array<std::vector<std::uint32_t>, 3> offset_;
};

}  // namespace shakedown
