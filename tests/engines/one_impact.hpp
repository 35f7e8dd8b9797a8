// SPDX-License-Identifier: MIT
// One impact of one sphere, in every engine and by the laws of rigid bodies: what the referees compare.
#pragma once
#include <string>

#include "physics.hpp"

namespace shakedown {

/// What a sphere meets: another one, a wall of a box that is held, an end or a side of a box that is free.
enum class Partner { grain, held_wall, end_wall, side_wall };
inline constexpr std::array<const char*, 4> partner_names{"grain", "held wall", "end wall", "side wall"};
inline constexpr std::array every_partner{Partner::grain, Partner::held_wall, Partner::end_wall,
                                          Partner::side_wall};

/// Where they meet: the normal points from the sphere to its partner, the tangent is one of the plane.
struct Place {
  Vec3 normal, tangent;
};
Place place_of(Partner partner);

/// Sphere and partner when they touch. SI; a wall has no other_ but the box's mass.
struct Encounter {
  Partner partner = Partner::grain;
  double radius = 0.005, mass = 4.04e-3;
  double other_radius = 0.005, other_mass = 4.04e-3;
  double box_mass = 0.434;
  Vec3 velocity = Vec3::Zero();  ///< of the sphere relative to its partner
  Vec3 spin = Vec3::Zero(), other_spin = Vec3::Zero();
  double restitution = 0.75;  ///< that was asked
  double friction = 0, tangential_restitution = 1, stiffness_ratio = ContactLaw::turning_ratio;
  double rolling_resistance = 0;
  double contact_time = 3e-4;  ///< of the soft engine
  double steps_per_contact = 50;
  double phase = 0.37;         ///< share of a step that is over at first touch
  double hertz_stiffness = 0;  ///< N/m^1.5; the soft engine's normal force is then Hertz's, without loss

  double closing() const { return velocity.dot(place_of(partner).normal); }
  /// Velocity of the sphere's touching point relative to the other's, across the normal, m/s.
  Vec3 slip() const;
  double reduced_mass() const;
  /// What the slip feels, per axis, kg: solid spheres turn as they are pushed.
  Vec3 tangential_mass() const;
};

/// A sphere that meets its partner at `degrees` from the normal with this speed.
Encounter meets(Partner partner, double degrees, double speed);

/// Velocities in the lab and spins; a wall's are its box's.
struct Motion {
  Vec3 velocity = Vec3::Zero(), other_velocity = Vec3::Zero(), spin = Vec3::Zero(), other_spin = Vec3::Zero();
};
Motion before(const Encounter& encounter);
/// The encounter with the velocities and spins of this motion in it.
Encounter with_motion(Encounter encounter, const Motion& motion);
/// J, of translation and spin; a held wall has none.
double energy_of(const Encounter& encounter, const Motion& motion);
/// What impulses along the normal and across make of it: (1 + e) v_n times the reduced mass, and `across`.
Motion pushed(const Encounter& encounter, const Vec3& across);

/// The law of rigid bodies: friction turns the slip round times the tangential restitution, or gives mu times
/// the normal impulse where that is less (O. R. Walton and R. L. Braun, J. Rheol. 30, 949 (1986)).
Motion by_rigid_bodies(const Encounter& encounter);
/// Slip after the impact over slip before, by the soft engine's law as documented (softsphere/friction.hpp)
/// for a contact too short to turn: integrated here in many small steps, with no code of the engines.
double by_tangential_spring(const Encounter& encounter);
/// The motion with this much of the slip left.
Motion with_slip_left(const Encounter& encounter, double share);

struct Outcome {
  Motion motion;
  std::int64_t impacts = 0;
  double energy_gained = 0;       ///< share of the energy before
  double deepest_overlap = 0;     ///< m
  double seconds_in_contact = 0;  ///< soft: from first touch to separation
};
/// Engine "hard", "soft" or "bullet" (its solver with our settings) on the encounter.
Outcome impact_by(const std::string& engine, const Encounter& encounter);

/// Setup of the encounter: the box, the law, its friction.
Setup setup_of(const Encounter& encounter);

}  // namespace shakedown
