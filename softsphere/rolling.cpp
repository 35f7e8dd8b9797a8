// SPDX-License-Identifier: MIT
#include "rolling.hpp"

#include <algorithm>

namespace shakedown {

namespace {
constexpr double most_of_a_half_kick = 0.25;
}

Vec3 rolling_torque(const ContactModel& model, const Bodies& bodies, const Contact& contact,
                    const Bodies::Rows& spin, double half_step) {
  const double coefficient = model.law.rolling_resistance[static_cast<std::size_t>(contact.kind)];
  if (coefficient == 0 || !contact.touching) return Vec3::Zero();
  Vec3 turning = (spin.row(contact.i) - spin.row(contact.j)).matrix();
  turning -= turning.dot(contact.normal) * contact.normal;
  const double rate = turning.norm();
  if (rate == 0) return Vec3::Zero();
  const bool pair = contact.kind == ContactClass::grain_grain;
  const double curvature = 1 / bodies.radius(contact.i) + (pair ? 1 / bodies.radius(contact.j) : 0.0);
  const double limit = coefficient / curvature * std::max(contact.elastic_force, 0.0);
  const double inertia = 1 / (bodies.inverse_inertia(contact.i) + bodies.inverse_inertia(contact.j));
  return turning * (-std::min(limit / rate, most_of_a_half_kick * inertia / half_step));
}

}  // namespace shakedown
