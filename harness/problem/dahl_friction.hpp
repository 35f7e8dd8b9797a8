// SPDX-License-Identifier: MIT
// Friction of a joint that yields before it slips (P. R. Dahl, A solid friction model, Aerospace Corporation
// TOR-0158(3107-18)-1, 1968; AIAA J. 14, 1675 (1976)). The resistance f against the motion obeys
//   df/dx = sigma (1 - f sgn(v) / F),  sigma = F / travel,
// so between two turning points, with x0 and f0 at the first, it is a closed form of the position alone:
//   f = F s - (F s - f0) exp(-|x - x0| / travel),  s = sgn(v).
// Stored in the joint: f^2 / (2 sigma); lost: |v| f^2 / F, never negative.
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

namespace shakedown {

struct DahlFriction {
  double force = 0;   ///< N, F: resistance when it slips, > 0
  double travel = 0;  ///< m, way in which it comes up to that: F / sigma, > 0
  int effect = -1;    ///< line in Setup::effects
};

/// The resistance of each joint along the path of one box. Unloaded at first.
class DahlState {
 public:
  explicit DahlState(const std::vector<DahlFriction>& joints)
      : joints_(joints), loaded_(joints.size(), 0.0) {}

  bool any() const { return !joints_.empty(); }  ///< whether there is a joint
  /// A stretch of the path ends at x (m) and another begins, towards greater x (`direction` +1), smaller
  /// (-1), or with the box at rest (0).
  void turn(double x, double direction) {
    for (std::size_t j = 0; j < joints_.size(); ++j) loaded_[j] = resistance(j, x);
    start_ = x;
    direction_ = direction;
  }
  /// Calls use(force on the box in N, effect) for each joint with the box at x.
  template <class Use>
  void each(double x, Use&& use) const {
    for (std::size_t j = 0; j < joints_.size(); ++j) use(-resistance(j, x), joints_[j].effect);
  }
  /// Returns the force of all joints on the box at x (m), N.
  double newton(double x) const {
    double sum = 0;
    for (std::size_t j = 0; j < joints_.size(); ++j) sum -= resistance(j, x);
    return sum;
  }
  /// Returns the shortest travel, m.
  double shortest_travel() const;

 private:
  /// Returns the resistance of joint j with the box at x, N. Behind the start of the stretch the law is
  /// continued analytically, for an integrator that looks a little too far.
  double resistance(std::size_t j, double x) const {
    if (direction_ == 0) return loaded_[j];
    const double moved = direction_ * (x - start_) / joints_[j].travel;
    return loaded_[j] - (direction_ * joints_[j].force - loaded_[j]) * std::expm1(-moved);
  }

  std::vector<DahlFriction> joints_;
  std::vector<double> loaded_;  // N, at the start of the stretch
  double start_ = 0, direction_ = 0;
};

}  // namespace shakedown
