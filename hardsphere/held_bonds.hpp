// SPDX-License-Identifier: MIT
// Grains held in square wells, where a step of depth F d and a constant attraction F over the gap d would
// part ways.
//
// Pull: a step holds what lies at rest against it with any force, a constant attraction with F. A grain that
// is pulled off slowly never reaches the edge with the energy F d, it hangs there and hops. So a bond that
// hangs and has been pulled with more than F, on the average since it last touched or was last judged, gives
// way. It has not paid for leaving; what that makes of energy, F d, is booked as work of the attraction. From
// rest at contact both rules are the same one: a pull P reaches the edge with P d.
//
// Rest: grains in wells hop without end at any speed below which impacts are elastic, at a rate of that speed
// over the free gap, which is nothing in a jammed row. So in wells slow impacts are elastic only when one of
// the two touched something less than `quick` ago (the contact time of S. Luding and S. McNamara, Granular
// Matter 1, 113 (1998)); others cool the grains on.
//
// Lasting contacts: grains that attraction holds against each other are pushed all at once, which costs less
// energy than one impact after the other (S. Luding et al., Phys. Rev. E 50, 4113 (1994), "detachment"). And
// five grains of 10 mm just fill a width of 50 mm: a row that wells press flat is wedged between the walls
// and carries that load, hundreds of times the attraction, by impacts, the more of them the slower they are
// (ten million a second). So impacts after a free path of less than `hairbreadth` are elastic at any speed.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace shakedown {

class HeldBonds {
 public:
  /// Impacts no further apart than this count as one rest, s. 0.1 ms gives the same slopes within the spread
  /// of runs at up to twice the cost.
  static constexpr double quick = 1e-3;
  /// After a free path shorter than this, m, impacts are elastic at any speed. A soft contact of 0.3 ms is as
  /// deep at 2 cm/s, the speed that a well of 20 mN and 0.02 mm gives. With that well and paths from 0 to
  /// 5e-6 m the slope at L = 40 mm goes from -8.44 to -8.16 mm/s (soft engine: -8.17). At 200 mN some runs
  /// of 8.5 s took over a minute without it.
  static constexpr double hairbreadth = 2e-6;

  /// `range`: of the wells, m.
  HeldBonds(std::size_t grains, double range) : range_(range), last_touch_(grains, -1.0) {}

  /// Returns the key of the bond of grains i and j, the same in either order.
  static std::uint64_t of_pair(int i, int j) {
    return static_cast<std::uint64_t>(std::min(i, j)) << 32 | static_cast<std::uint64_t>(std::max(i, j));
  }
  /// Returns the key of the bond of grain i with the wall across `axis` (0 to 2) on this side (+1 or -1).
  static std::uint64_t of_wall(int i, int axis, int side) {
    return std::uint64_t{1} << 63 | of_pair(i, 0) << 8 | static_cast<std::uint64_t>(2 * axis + (side > 0));
  }

  /// Returns the closing speed below which an impact of grains i and j (j < 0: of i and a wall) at time `now`
  /// is elastic, m/s: at least `limit` where one of them touched something less than `quick` ago, else 0.
  double elastic_below(double limit, int i, int j, double now) const {
    const double last = std::max(last_touch_[static_cast<std::size_t>(i)],
                                 j < 0 ? -1.0 : last_touch_[static_cast<std::size_t>(j)]);
    const double since = now - last;
    return since < quick ? std::max(limit, hairbreadth / since) : 0;
  }
  /// Notes that grain i touches something at time `now`, s.
  void touches(int i, double now) { last_touch_[static_cast<std::size_t>(i)] = now; }

  /// Notes that the two of this bond touched at time `now` and part with this momentum, N s (reduced mass
  /// times opening speed): nothing has pulled at them yet.
  void touched(std::uint64_t bond, double momentum, double now) { pulls_[bond] = {now, -momentum}; }

  /// Judges two that came to the edge of their well with too little energy to leave; true when they were
  /// pulled with more than their attraction `force`, N, and are let go. `reduced_mass`: kg; `opening_speed`:
  /// m/s.
  bool gives_way(std::uint64_t bond, double force, double reduced_mass, double opening_speed, double now) {
    const double momentum = reduced_mass * opening_speed;
    Pull& pull = pulls_.try_emplace(bond, Pull{now, 0}).first->second;
    const double time = now - pull.since;
    // in less the attraction itself would not cross its range
    if (time < std::sqrt(2 * range_ * reduced_mass / force)) {
      pull.impulse += 2 * momentum;
      return false;
    }
    const bool pulled = pull.impulse + momentum > force * time;
    pull = {now, momentum};
    return pulled;
  }

 private:
  struct Pull {
    double since;    ///< s
    double impulse;  ///< N s, what has turned the two round and driven them apart since `since`
  };
  double range_;
  std::vector<double> last_touch_;
  std::unordered_map<std::uint64_t, Pull> pulls_;
};

}  // namespace shakedown
