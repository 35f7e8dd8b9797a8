// SPDX-License-Identifier: MIT
// Flight of the box on its spring between two kicks, in closed form.
//   M x'' = -k x      =>  x(t) = x0 cos W(t - t0) + (v0 / W) sin W(t - t0),  W = sqrt(k / M)
// The state is (x, v) at the last kick (physics: amplitude and phase are outputs), so no arctangent and no
// growing phase enters.
#pragma once
#include <cmath>
#include <limits>

namespace shakedown {

class BoxMotion {
 public:
  struct Point {
    double x, v;
  };

  BoxMotion(double mass, double stiffness, double x, double v, double time = 0)
      : mass_(mass), stiffness_(stiffness), angular_frequency_(std::sqrt(stiffness / mass)) {
    if (angular_frequency_ > 0) impulse_scale_ = -stiffness / angular_frequency_;
    restart(time, x, v);
  }

  /// Position and velocity at time t; exact for every t (also before the last kick, along the same arc).
  Point at(double t) const {
    if (angular_frequency_ == 0) return {x_ + v_ * (t - time_), v_};
    const double phase = angular_frequency_ * (t - time_);
    const double c = std::cos(phase), s = std::sin(phase);
    // Two sums on purpose: of a sum beside a difference GCC 12 makes one fused instruction where it inlines,
    // whatever -ffp-contract says (a motion would then depend in its last digit on who asks for it).
    return {x_ * c + y_ * s, v_ * c + -x_ * angular_frequency_ * s};
  }

  /// A kick: from time t on the box flies from (x, v).
  void restart(double t, double x, double v) {
    time_ = t;
    x_ = x;
    v_ = v;
    y_ = angular_frequency_ > 0 ? v / angular_frequency_ : 0;
    amplitude_ = std::sqrt(x * x + y_ * y_);  // metres: nothing that hypot would have to guard against
  }

  struct PointAndImpulse {
    Point point;
    double spring_impulse;  ///< of the spring from the last kick to then, N s: -k integral of x
  };
  /// Returns the point at time t and the spring's impulse since the last kick, both from one sine and cosine.
  PointAndImpulse at_with_impulse(double t) const {
    if (angular_frequency_ == 0) return {at(t), 0};
    const double phase = angular_frequency_ * (t - time_);
    const double c = std::cos(phase), s = std::sin(phase);
    const double versine = c > 0 ? s * s / (1 + c) : 1 - c;  // 1 - cos without cancellation
    return {{x_ * c + y_ * s, v_ * c + -x_ * angular_frequency_ * s},
            impulse_scale_ * (x_ * s + y_ * versine)};
  }

  /// Returns the energy of box and spring, J; it stays the same between kicks.
  double energy() const { return stiffness_ * x_ * x_ / 2 + mass_ * v_ * v_ / 2; }
  double mass() const { return mass_; }
  double stiffness() const { return stiffness_; }
  double spring_energy(double x) const { return stiffness_ * x * x / 2; }  ///< J
  double angular_frequency() const { return angular_frequency_; }
  double amplitude() const { return amplitude_; }                               ///< m, of the present arc
  double top_speed() const { return amplitude_ * angular_frequency_; }          ///< m/s
  double top_acceleration() const { return top_speed() * angular_frequency_; }  ///< m/s^2, bound of |x''|
  /// Returns the time until which at() and the bounds hold without a restart, s: there is no end.
  static constexpr double valid_until() { return std::numeric_limits<double>::infinity(); }
  double x() const { return x_; }        ///< at the last kick
  double v() const { return v_; }        ///< after the last kick
  double time() const { return time_; }  ///< of the last kick

 private:
  double mass_, stiffness_, angular_frequency_, impulse_scale_ = 0;
  double time_ = 0, x_ = 0, v_ = 0, y_ = 0, amplitude_ = 0;  // y: v over the angular frequency, m
};

}  // namespace shakedown
