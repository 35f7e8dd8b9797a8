// SPDX-License-Identifier: MIT
// Impacts of hard spheres: impulse along the normal mu (1 + eps) times the closing speed; with friction a
// tangential impulse that would reverse the slip of the touching points (times the tangential restitution),
// limited by mu_friction times the normal one. Solid spheres: I = (2/5) m r^2, so slip feels the mass m
// / 3.5.
#pragma once
#include <Eigen/Geometry>
#include <cmath>

#include "physics.hpp"

namespace shakedown {

/// A tangential impulse and the energy that it takes out.
struct Friction {
  Vec3 impulse = Vec3::Zero();  ///< N s
  double loss = 0;              ///< J
};

/// `slip`: velocity of the touching point relative to the other's, tangential part, m/s; `mass`: per axis,
/// what the slip feels, kg. Scaling both components alike keeps the loss positive for any masses.
inline Friction friction_impulse(const Vec3& slip, const Vec3& mass, double coefficient,
                                 double tangential_restitution, double normal_impulse) {
  const Vec3 reversing = -(1 + tangential_restitution) * mass.cwiseProduct(slip);
  const double needed = reversing.norm(), allowed = coefficient * normal_impulse;
  if (needed == 0 || allowed <= 0) return {};
  const Vec3 impulse = needed <= allowed ? reversing : Vec3(reversing * (allowed / needed));
  return {impulse, -(impulse.dot(slip) + impulse.cwiseProduct(impulse).cwiseQuotient(mass).sum() / 2)};
}

/// Change of spin of a sphere by an impulse at its surface point in direction `normal` from its centre,
/// rad/s.
inline Vec3 spin_change(const Vec3& normal, double radius, double mass, const Vec3& impulse) {
  return normal.cross(impulse) * (2.5 / (mass * radius));
}

}  // namespace shakedown
