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
        harmonics_.push_back({h.amplitude, w, h.phase, std::sin(h.phase), std::cos(h.phase), h.effect});
      else
        constants_.add(h.amplitude * std::sin(h.phase), h.effect);
    }
    constant_ = constants_.sum();
    at_rest_ = constant_.isZero() && harmonics_.empty();
  }

  bool at_rest() const { return at_rest_; }  ///< nothing accelerates: the frame is the lab's
  /// Returns S(t), m: how far the frame has fallen at time t, s after release.
  Vec3 displacement(double t) const {
    Vec3 s = constant_ * (t * t / 2);
    for (const Swing& h : harmonics_)
      s += h.amplitude * ((h.sine - std::sin(h.w * t + h.phase)) / (h.w * h.w) + h.cosine * t / h.w);
    return s;
  }
  /// Returns S'(t), m/s.
  Vec3 velocity(double t) const {
    Vec3 v = constant_ * t;
    for (const Swing& h : harmonics_) v += h.amplitude * ((h.cosine - std::cos(h.w * t + h.phase)) / h.w);
    return v;
  }
  struct Point {
    Vec3 x, v;  ///< m, m/s
  };
  /// Returns displacement and velocity at time t; the last answer is kept for others who ask for that moment.
  const Point& at(double t) const {
    if (!at_rest_ && t != time_) {
      here_ = {displacement(t), velocity(t)};
      time_ = t;
    }
    return here_;
  }
  /// Calls use(effect, acceleration) for each effect's own acceleration at time t.
  template <class Use>
  void each(double t, Use&& use) const {
    for (const auto& share : constants_.shares()) use(share.effect, share.strength);
    for (const Swing& h : harmonics_) use(h.effect, Vec3(h.amplitude * std::sin(h.w * t + h.phase)));
  }
  /// Returns a bound of the acceleration along an axis, m/s^2.
  double top(int axis) const {
    double sum = std::abs(constant_[axis]);
    for (const Swing& h : harmonics_) sum += std::abs(h.amplitude[axis]);
    return sum;
  }
  /// Returns the highest angular frequency of the harmonics, rad/s; 0 without any.
  double top_frequency() const {
    double top = 0;
    for (const Swing& h : harmonics_) top = std::max(top, h.w);
    return top;
  }

 private:
  struct Swing {
    Vec3 amplitude;
    double w, phase, sine, cosine;  // of the phase
    int effect;
  };
  Slot<Vec3> constants_;
  Vec3 constant_;  // their sum
  std::vector<Swing> harmonics_;
  bool at_rest_ = true;
  mutable double time_ = -1;
  mutable Point here_{Vec3::Zero(), Vec3::Zero()};
};

}  // namespace shakedown
