// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "damper_state.hpp"
#include "grain_event.hpp"

namespace shakedown {

/// Grains of a replay: they fly and predict nothing, because their events come from a log. Members mean what
/// event_loop.hpp says of `Grains`; the four that find events (next, event, is_stale, leave_neighbourhood)
/// are left out, as a scripted loop asks for none.
class ScriptedGrains {
 public:
  static constexpr bool scripted = true;
  struct Next {
    double time;
    int grain;
  };

  explicit ScriptedGrains(const State& state) : radius_(state.radius), mass_(state.mass) {
    for (std::size_t i = 0; i < state.size(); ++i) {
      const Vec3 &x = state.position[i], &v = state.velocity[i];
      flight_.push_back({{x.x(), x.y(), x.z()}, {v.x(), v.y(), v.z()}, 0});
    }
  }

  /// What each does stands in event_loop.hpp; nothing is predicted here, so set_flight() makes nothing stale.
  int size() const { return static_cast<int>(flight_.size()); }
  const Flight3& flight(int i) const { return flight_[static_cast<std::size_t>(i)]; }
  void set_flight(int i, const Flight3& flight) { flight_[static_cast<std::size_t>(i)] = flight; }
  void move_to(int i, const Flight3& flight) { set_flight(i, flight); }
  double radius(int i) const { return radius_[static_cast<std::size_t>(i)]; }
  double mass(int i) const { return mass_[static_cast<std::size_t>(i)]; }
  std::array<double, 3> separation(const Flight3& a, const Flight3& b) const {
    return {b.x[0] - a.x[0], b.x[1] - a.x[1], b.x[2] - a.x[2]};
  }
  /// Returns zeros: a replay balances no energy.
  GrainSums sums(double) const { return {}; }

  /// Do nothing, or return 0: the log says what happens, and nobody looks for overlaps.
  void set_bond(int, int, bool) {}
  int bonds() const { return 0; }
  void predict(int) {}
  void predict(int, int) {}
  void predict_all() {}
  void forget_side_walls() {}
  double deepest_overlap() const { return 0; }
  double bytes_per_grain() const { return sizeof(Flight3) + 2 * sizeof(double); }  ///< B

 private:
  std::vector<Flight3> flight_;
  std::vector<double> radius_, mass_;
};

}  // namespace shakedown
