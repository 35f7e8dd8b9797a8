// SPDX-License-Identifier: MIT
// Grains of a small system (the paper's 37): structure of arrays, every pair tested in vector lanes, the next
// event found by a vector scan. No lists, no queue: at this size both cost more than they save.
#pragma once
#include <vector>

#include "damper_state.hpp"
#include "grain_event.hpp"
#include "lanes.hpp"

namespace shakedown {

class AllPairs {
 public:
  struct Next {
    double time;
    int grain;
  };

  /// `room`: half widths of the box along y and z; each grain's radius is taken off. Infinite: no side walls.
  /// `attraction_range`: how far a square well reaches beyond contact, m (0: none).
  AllPairs(const State& state, std::array<double, 2> half_width, double attraction_range = 0);

  int size() const { return static_cast<int>(size_); }  ///< number of grains
  /// Returns the flight that grain i is on: place, m, and velocity, m/s, at its own time, s.
  Flight3 flight(int i) const {
    const std::size_t k = static_cast<std::size_t>(i);
    return {{x_[k], y_[k], z_[k]}, {vx_[k], vy_[k], vz_[k]}, time_[k]};
  }
  /// Gives a grain its flight after an impact; what was predicted with it is stale.
  void set_flight(int i, const Flight3& flight) {
    move_to(i, flight);
    ++count_[static_cast<std::size_t>(i)];
    sums_time_ = never;
  }
  /// Brings a grain to another point of the flight it is on.
  void move_to(int i, const Flight3& flight) {
    const std::size_t k = static_cast<std::size_t>(i);
    x_[k] = flight.x[0];
    y_[k] = flight.x[1];
    z_[k] = flight.x[2];
    vx_[k] = flight.v[0];
    vy_[k] = flight.v[1];
    vz_[k] = flight.v[2];
    time_[k] = flight.time;
  }
  double radius(int i) const { return radius_[static_cast<std::size_t>(i)]; }
  double mass(int i) const { return mass_[static_cast<std::size_t>(i)]; }
  /// Leaves the side walls to EndWalls.
  void forget_side_walls() { half_width_ = {never, never}; }
  /// Enters whether two grains are in each other's well; bonds() returns how many pairs are.
  void set_bond(int i, int j, bool bond);
  int bonds() const;
  std::array<double, 2> side_room(int i) const {
    return {half_width_[0] - radius(i), half_width_[1] - radius(i)};
  }

  /// Returns the earliest event; kept, as the loop asks twice for each, for its time and to execute it.
  const Next& next() {
    if (next_.grain < 0) {
      const Smallest earliest = smallest(event_time_, padded_size_);
      next_ = {earliest.value, earliest.index};
    }
    return next_;
  }
  GrainEvent event(int i) const {
    const std::size_t k = static_cast<std::size_t>(i);
    return {event_time_[k], partner_[k], partner_count_[k], meeting_[k]};
  }
  bool is_stale(const GrainEvent& event) const {
    return event.partner >= 0 && count_[static_cast<std::size_t>(event.partner)] != event.partner_count;
  }
  /// Returns the sums at time t, s. They are found anew only after an impact: in long boxes most samples see
  /// none since the one before.
  GrainSums sums(double t);
  /// Predicts the next event of a grain, or of both grains of a pair, whose flights start now.
  void predict(int i);
  void predict(int i, int j);
  void predict_all();
  /// Predicts all grains, whose flights must all start now, and may leave out touches after `end`, s.
  void predict_all_before(double end);
  void leave_neighbourhood(int, double) {}
  std::array<double, 3> separation(const Flight3& a, const Flight3& b) const {
    return {b.x[0] - a.x[0], b.x[1] - a.x[1], b.x[2] - a.x[2]};
  }

  /// Returns the memory held for each grain, B.
  double bytes_per_grain() const { return 10 * sizeof(double) + 3 * sizeof(std::int32_t); }
  /// Returns the largest overlap of two grains met so far, m.
  double deepest_overlap() const;

 private:
  /// The next touch of a grain with any other, counted from the time of its flight.
  struct Touch {
    double wait = never;  ///< s
    std::int32_t partner = no_partner;
    Meeting meeting = Meeting::touch;
  };
  /// Grains as vectors of equal numbers.
  template <int K>
  struct Selves;
  template <int K, bool Well>
  std::array<Touch, K> first_touches(const std::array<int, K>& who);
  template <int K, bool Well>
  std::array<Touch, K> estimated_touches(const std::array<int, K>& who);
  template <bool Well>
  Touch touch_of(int i, int j) const;
  void find_who_may_touch(double wait, std::vector<char>& may) const;
  bool bonded(int i, int j) const {
    return bond_[static_cast<std::size_t>(i) * padded_size_ + static_cast<std::size_t>(j)] != 0;
  }
  /// Tells which grains from j on share a well with i.
  Lanes::mask_type bonds(int i, std::size_t j) const {
    return load(bond_, static_cast<std::size_t>(i) * padded_size_ + j) > Lanes(0.5);
  }
  template <int K, bool Well>
  void predict_grains(const std::array<int, K>& who);

  std::size_t size_, padded_size_;
  std::array<double, 2> half_width_;
  AlignedVector<double> x_, y_, z_, vx_, vy_, vz_, time_, radius_, mass_, event_time_;
  std::vector<std::int32_t> partner_;
  std::vector<std::uint32_t> partner_count_, count_;
  std::vector<Meeting> meeting_;
  double range_ = 0;
  AlignedVector<double> bond_;   // 1 or 0 for each pair, a padded row a grain; empty without attraction
  Next next_{never, -1};         // grain -1: not known
  double smallest_room_ = 0;     // of r^2 - reach^2, m^2
  std::vector<char> may_touch_;  // of every grain, where all are predicted at once
  GrainSums sums_;
  double sums_time_ = never;  // never: not known
};

}  // namespace shakedown
