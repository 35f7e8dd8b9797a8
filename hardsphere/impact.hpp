// SPDX-License-Identifier: MIT
// Impacts of hard spheres: impulse along the normal mu (1 + eps) times the closing speed; with friction a
// tangential impulse that would reverse the slip of the touching points (times the tangential restitution),
// limited by mu_friction times the normal one. Solid spheres: I = (2/5) m r^2, so slip feels the mass m
// / 3.5. Surfaces that give way sideways leave what their tangential spring does (compliant_slip.hpp).
// Rolling resistance is an angular impulse that would stop the relative rolling, limited by its coefficient
// times the reduced radius times the normal impulse.
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "compliant_slip.hpp"
#include "physics.hpp"

namespace shakedown {

/// A tangential impulse and the energy that it takes out.
struct Friction {
  Vec3 impulse = Vec3::Zero();  ///< N s
  double loss = 0;              ///< J
};

/// What presses the surfaces together.
struct NormalImpact {
  double reduced_mass = 0;  ///< kg
  double closing = 0;       ///< m/s
  double restitution = 1;
  double impulse = 0;  ///< N s
};

/// Returns the impulse of friction on the first body. `slip`: velocity of its touching point relative to the
/// other's, tangential part, m/s; `mass`: kg along each axis, which the slip feels. Both components are
/// scaled alike, which keeps the loss positive for any masses.
inline Friction friction_impulse(const Vec3& slip, const Vec3& mass, double coefficient,
                                 const ContactLaw& law, const NormalImpact& normal) {
  const Vec3 stopping = mass.cwiseProduct(slip);
  const double felt = stopping.norm(), allowed = coefficient * normal.impulse;
  if (felt == 0 || allowed <= 0) return {};
  Vec3 impulse;
  if (law.stiffness_ratio == ContactLaw::turning_ratio) {
    const Vec3 reversing = -(1 + law.tangential_restitution) * stopping;
    const double needed = reversing.norm();
    impulse = needed <= allowed ? reversing : Vec3(reversing * (allowed / needed));
  } else {
    const double speed = slip.norm();
    impulse = (compliant_slip({speed / (coefficient * normal.closing), felt / speed / normal.reduced_mass,
                               normal.restitution, law.stiffness_ratio, law.tangential_restitution}) -
               1) *
              stopping;
  }
  return {impulse, -(impulse.dot(slip) + impulse.cwiseProduct(impulse).cwiseQuotient(mass).sum() / 2)};
}

/// An angular impulse against the relative rolling and the energy that it takes out.
struct Rolling {
  Vec3 impulse = Vec3::Zero();  ///< N m s
  double loss = 0;              ///< J
};

/// Returns the angular impulse of rolling resistance. `turning`: spin relative to the partner's across the
/// normal, rad/s; `inertia`: kg m^2, which the turning feels; `limit`: N m s, largest angular impulse.
inline Rolling rolling_impulse(const Vec3& turning, double inertia, double limit) {
  const double rate = turning.norm(), size = std::min(inertia * rate, limit);
  if (rate == 0 || limit <= 0) return {};
  return {turning * (-size / rate), size * (rate - size / (2 * inertia))};
}

/// Returns the moment of inertia of a solid sphere, kg m^2.
inline double inertia_of(double mass, double radius) { return 0.4 * mass * radius * radius; }

/// Returns the change of spin of a sphere, rad/s, by an impulse (N s) at its surface point in direction
/// `normal` from its centre.
inline Vec3 spin_change(const Vec3& normal, double radius, double mass, const Vec3& impulse) {
  return normal.cross(impulse) * (2.5 / (mass * radius));
}

}  // namespace shakedown
