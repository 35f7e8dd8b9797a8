// SPDX-License-Identifier: MIT
// A contact of a soft run, and the numbers that all contacts of a run share.
#pragma once
#include <array>
#include <cstdint>

#include "bodies.hpp"
#include "spring_dashpot.hpp"

namespace shakedown {

struct Contact {
  std::uint64_t key = 0;  ///< order in which forces are summed: pairs by (i, j), then walls by (grain, wall)
  int i = 0, j = 0;       ///< j is the box when it is the number of grains
  ContactClass kind = ContactClass::grain_grain;
  Vec3 normal = Vec3::Zero();  ///< unit, from j to i
  double overlap = 0;          ///< m, negative: a gap bridged by attraction
  double reduced_mass = 0;     ///< kg
  double closing_speed = 0;    ///< m/s, at first touch
  double friction = 0;         ///< Coulomb coefficient of the slip at first touch
  SpringDashpot spring;
  bool touching = false;
  bool over = false;  ///< separated in this step; leaves after the closing half kick
  // Weights in the coming half kick.
  double dashpot = 1;
  double attraction = 0;
  Vec3 stretch = Vec3::Zero();  ///< m, of the tangential spring
  // Forces found at the last evaluation.
  double normal_force = 0;               ///< N, on i along the normal
  double elastic_force = 0;              ///< N, the share of overlap alone in it
  Vec3 tangential_force = Vec3::Zero();  ///< N, on i
  Vec3 rolling_torque = Vec3::Zero();    ///< N m, on i; on j the opposite
  bool sliding = false;                  ///< the tangential force is at its limit
};

/// The numbers that all contacts of one run share.
struct ContactModel {
  ContactLaw law;
  double contact_time = 0;  ///< s
  double box_mass = 0;      ///< kg; 0: held still
  double length = 0;        ///< m, inner size of the box
  std::array<double, 2> width{};
};

}  // namespace shakedown
