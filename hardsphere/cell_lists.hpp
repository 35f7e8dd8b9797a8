// SPDX-License-Identifier: MIT
// Grains of a large system: one cache line a grain, neighbour lists found through cells, a calendar of one
// event a grain. The cost of an impact does not depend on the number of grains.
//
// A list holds the grains whose list centres lie within `shell` of one's own; a grain renews its list when it
// has moved `leeway` from its centre, an event like any other. Spheres touch at `reach` at most, so with
// shell = reach + 2 leeway no partner can be missed.
#pragma once
#include <vector>

#include "centre_cells.hpp"
#include "scheduled_grains.hpp"

namespace shakedown {

struct CellListsPlan {
  std::array<double, 3>
      cell{};  ///< m, extent of the domain along each axis; grains may leave it, cells wrap around
  bool periodic = false;
  std::array<double, 2> half_width{never, never};  ///< side walls, m
  double packing_fraction = 0.5;                   ///< local; sets the shell
  double shell = 0;  ///< in units of the largest diameter; 0: chosen by packing fraction
};

template <bool Periodic>
class CellLists : public ScheduledGrains {
 public:
  CellLists(const State& state, const CellListsPlan& plan);

  /// Leaves the side walls to EndWalls.
  void forget_side_walls() { half_width_ = {never, never}; }
  /// Returns time, s, and grain of the earliest event; grain -1 when there is none.
  Next next() {
    return next_event(looks, [this](int i, int days) { prefetch(i, days); });
  }
  /// Returns the next event of grain i as it was predicted: an impact, a side wall, or (its partner is then
  /// leaves_neighbourhood) the end of what its list of neighbours is good for.
  GrainEvent event(int i) const;
  /// Finds the next event of grain i, whose flight starts now.
  void predict(int i) { remember(i, next_of(i)); }
  /// Both are found before either is remembered: each is a long chain of dependent operations, and the two
  /// overlap.
  void predict(int i, int j) {
    const GrainEvent of_i = next_of(i), of_j = next_of(j);
    remember(i, of_i);
    remember(j, of_j);
  }
  void predict_all() {
    plan_all([this](int i) { predict(i); });
  }
  /// Renews the list of a grain that has reached its leeway.
  void leave_neighbourhood(int i, double now);
  /// Vector from a to the nearest image of b.
  std::array<double, 3> separation(const Flight3& a, const Flight3& b) const;
  double bytes_per_grain() const;

 private:
  static constexpr std::array looks{16, 10, 5};  ///< days ahead, at grains whose lines are to be brought near
  /// What only the grain itself needs, in one cache line.
  struct alignas(64) Own {
    std::array<double, 3> centre;  ///< of its list
    std::int32_t partner = no_partner;
    std::uint32_t partner_count = 0;
    std::uint32_t list_size = 0;
  };

  /// Finds the next event of grain i among its neighbours, its leeway and the side walls.
  GrainEvent next_of(int i);
  void remember(int i, const GrainEvent& next);
  void prefetch(int i, int days) const;
  void prefetch_neighbours(std::size_t i) const;
  void add_neighbour(std::size_t i, std::int32_t neighbour);
  void remove_neighbour(std::size_t i, std::int32_t neighbour);
  /// Makes room for eight more neighbours in every list.
  void widen_lists();
  double nearest(double r, std::size_t axis) const { return Periodic ? lines_.period().nearest(r, axis) : r; }
  double time_to_leave(std::size_t i, const Flight3& flight, double wait) const;
  std::int32_t* list(std::size_t i) { return &list_[i * list_room_]; }

  AlignedVector<Own> own_;
  AlignedVector<std::int32_t> list_;  // a row a grain, filled up with the grain itself
  std::size_t list_room_ = 24;
  CentreCells centres_;
  std::vector<std::int32_t> near_;  // found in centres_
  std::array<double, 2> half_width_{};
  double leeway_;
};

extern template class CellLists<true>;
extern template class CellLists<false>;

}  // namespace shakedown
