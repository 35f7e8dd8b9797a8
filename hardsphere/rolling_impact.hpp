// SPDX-License-Identifier: MIT
// An impact with friction and rolling resistance at once, where one makes the other: at a wall friction turns
// the grain, and what stops its turning makes it slip. The soft engine's springs (softsphere/friction.hpp)
// and its torque (softsphere/rolling.hpp) integrated over the impact, in the limit of contacts too short to
// turn. Between grains that are alike the two do not meet, and each has its own law (impact.hpp).
#pragma once
#include "impact.hpp"

namespace shakedown {

struct RollingContact {
  Vec3 slip = Vec3::Zero();     ///< m/s, of the first's surface past the other's
  Vec3 turning = Vec3::Zero();  ///< rad/s, spin of the first less the other's, across the normal
  Vec3 normal = Vec3::Zero();   ///< from the first to the other
  Vec3 mass = Vec3::Zero();     ///< kg, per axis, what the slip feels
  double inertia = 0;           ///< kg m^2, what the turning feels
  double coupling = 0;          ///< 1/(kg m): R/I of the first less that of the other
  double friction = 0;          ///< coefficient
  double rolling = 0;           ///< m, coefficient times reduced radius
};

/// Impulse on the first along the surface, N s, angular impulse of the rolling resistance on it, N m s, and
/// what both take, J.
struct RollingImpact {
  Vec3 impulse = Vec3::Zero(), turning = Vec3::Zero();
  double loss = 0;
};
/// Returns what friction and rolling resistance do to the first body in one impact.
RollingImpact rolling_impact(const RollingContact& contact, const ContactLaw& law,
                             const NormalImpact& normal_impact);

}  // namespace shakedown
