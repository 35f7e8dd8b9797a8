// SPDX-License-Identifier: MIT
// Accelerations that all grains share, a(t) = constant + sum of amplitude sin(2 pi f t + phase), are taken
// out by describing the grains in a frame that falls with them: lab = frame + S(t), S'' = a, S(0) = S'(0) =
// 0. There grains fly straight and pairs meet as if nothing acted; only the walls move, by -S(t).
#pragma once
#include <cmath>
#include <numbers>
#include <vector>

#include "physics.hpp"

namespace shakedown {

class FallingFrame {
 public:
  explicit FallingFrame(const GrainForces& forces) : constants_(forces.constant) {
    for (const auto& h : forces.harmonics) {
      const double w = 2 * std::numbers::pi * h.frequency;
      if (w > 0)
        harmonics_.push_back({h.amplitude, w, h.phase, h.effect});
      else
        constants_.add(h.amplitude * std::sin(h.phase), h.effect);
    }
    constant_ = constants_.sum();
  }

  bool at_rest() const { return constant_.isZero() && harmonics_.empty(); }
  Vec3 displacement(double t) const {
    Vec3 s = constant_ * (t * t / 2);
    for (const Swing& h : harmonics_)
      s += h.amplitude *
           ((std::sin(h.phase) - std::sin(h.w * t + h.phase)) / (h.w * h.w) + std::cos(h.phase) * t / h.w);
    return s;
  }
  Vec3 velocity(double t) const {
    Vec3 v = constant_ * t;
    for (const Swing& h : harmonics_)
      v += h.amplitude * ((std::cos(h.phase) - std::cos(h.w * t + h.phase)) / h.w);
    return v;
  }
  /// Calls use(effect, acceleration) for each effect's own acceleration at time t.
  template <class Use>
  void each(double t, Use&& use) const {
    for (const auto& share : constants_.shares()) use(share.effect, share.strength);
    for (const Swing& h : harmonics_) use(h.effect, Vec3(h.amplitude * std::sin(h.w * t + h.phase)));
  }
  /// Bound of the acceleration along an axis, m/s^2.
  double top(int axis) const {
    double sum = std::abs(constant_[axis]);
    for (const Swing& h : harmonics_) sum += std::abs(h.amplitude[axis]);
    return sum;
  }
  /// Fastest angular frequency in it, rad/s.
  double top_frequency() const {
    double top = 0;
    for (const Swing& h : harmonics_) top = std::max(top, h.w);
    return top;
  }

 private:
  struct Swing {
    Vec3 amplitude;
    double w, phase;
    int effect;
  };
  Slot<Vec3> constants_;
  Vec3 constant_;  // their sum
  std::vector<Swing> harmonics_;
};

}  // namespace shakedown
