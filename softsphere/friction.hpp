// SPDX-License-Identifier: MIT
// Coulomb friction with spins: a tangential spring of 2/7 of the normal one, which slides at mu times the normal force (Cundall
// and Strack 1979). A spring of 2/7 k reverses the slip of solid spheres in the contact time; a dashpot beside it makes that
// tangential restitution smaller than one.
#pragma once
#include "contacts.hpp"

namespace shakedown {

double tangential_stiffness(const Contact& contact);

/// Velocity of i relative to j at their point of contact, across the normal, m/s.
Vec3 slip_velocity(const Bodies& bodies, const Contact& contact);

/// Turns the spring into the new tangent plane, keeping its length, and stretches it by the slip during `time` seconds.
void stretch_tangentially(const Bodies& bodies, double time, Contact& contact);

/// Sets the tangential force for the current velocities.
void set_friction(const ContactModel& model, const Bodies& bodies, Contact& contact);

/// After the last evaluation: a spring that slides keeps the stretch that its force stands for.
void let_slide(Contact& contact);

/// Distance from the centre of i (or j) to the point of contact, m. The levers of a pair add up to the distance of the centres,
/// so that friction conserves angular momentum.
double lever_of_first(const Bodies& bodies, const Contact& contact);
double lever_of_second(const Bodies& bodies, const Contact& contact);

}  // namespace shakedown
