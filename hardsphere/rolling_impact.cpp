// SPDX-License-Identifier: MIT
#include "rolling_impact.hpp"

#include <numbers>

namespace shakedown {

namespace {

constexpr int steps_of_rolling = 200;

/// Integrates one contact. Times are in contact times over pi, so that forces are impulses; turning is kept
/// as the velocity across the normal that it gives a surface at unit distance.
class Integration {
 public:
  Integration(const RollingContact& contact, const ContactLaw& law, const NormalImpact& impact)
      : contact_(contact), decay_(dashpot_decay(impact.restitution)) {
    const double across = dashpot_decay(law.tangential_restitution), stiffness = 1 + decay_ * decay_;
    press_ = impact.reduced_mass * stiffness * impact.closing;
    spring_ =
        impact.reduced_mass * (law.stiffness_ratio * stiffness + ContactLaw::turning_ratio * across * across);
    dashpot_ = impact.reduced_mass * 2 * ContactLaw::turning_ratio * across;
    slip_ = contact.slip;
    turning_ = contact.turning.cross(contact.normal);
  }

  RollingImpact run() {
    const Vec3 slip_before = slip_, turning_before = turning_;
    for (int k = 0; k < steps_of_rolling; ++k) advance((k + 0.5) * step);
    RollingImpact result;
    result.impulse = impulse_;
    result.turning = contact_.normal.cross(torque_);
    result.loss = -(impulse_.dot(slip_before + slip_) + torque_.dot(turning_before + turning_)) / 2;
    return result;
  }

 private:
  static constexpr double step = std::numbers::pi / steps_of_rolling;

  void advance(double time) {
    const double pressed = press_ * std::exp(-decay_ * time) * std::sin(time);
    stretch_ += slip_ * (step / 2);
    const Vec3 rubbed = friction(contact_.friction * pressed) * step;
    impulse_ += rubbed;
    slip_ += rubbed.cwiseQuotient(contact_.mass);
    turning_ += contact_.coupling * rubbed;
    if (const double rate = turning_.norm(); rate > 0) {
      const Vec3 twist = turning_ * (-std::min(contact_.rolling * pressed * step / rate, contact_.inertia));
      torque_ += twist;
      turning_ += twist / contact_.inertia;
      slip_ += contact_.coupling * twist;
    }
    stretch_ += slip_ * (step / 2);
  }

  /// Returns the tangential force, at most `most` in size; a spring that slides keeps the stretch that its
  /// share of the force stands for, as in softsphere/friction.cpp.
  Vec3 friction(double most) {
    const Vec3 wanted = -spring_ * stretch_ - dashpot_ * slip_;
    const double size = wanted.norm();
    if (size <= most) return wanted;
    const Vec3 force = wanted * (most / size), of_spring = force + dashpot_ * slip_;
    stretch_ = of_spring.dot(force) <= 0 ? Vec3(Vec3::Zero()) : Vec3(-of_spring / spring_);
    return force;
  }

  const RollingContact& contact_;
  double decay_, press_, spring_, dashpot_;
  Vec3 slip_, turning_, stretch_ = Vec3::Zero(), impulse_ = Vec3::Zero(), torque_ = Vec3::Zero();
};

}  // namespace

RollingImpact rolling_impact(const RollingContact& contact, const ContactLaw& law,
                             const NormalImpact& normal_impact) {
  if (contact.coupling != 0) return Integration(contact, law, normal_impact).run();
  const Friction friction =
      friction_impulse(contact.slip, contact.mass, contact.friction, law, normal_impact);
  const Rolling rolling =
      rolling_impulse(contact.turning, contact.inertia, contact.rolling * normal_impact.impulse);
  return {friction.impulse, rolling.impulse, friction.loss + rolling.loss};
}

}  // namespace shakedown
