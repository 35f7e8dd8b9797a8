// SPDX-License-Identifier: MIT
// Coulomb friction with spins: a tangential spring of the law's ratio to the normal one, which slides at mu
// times the normal spring's force (after Cundall and Strack 1979). By a ratio of 2/7 solid spheres turn their
// slip round in the contact time, as tangential restitution 1 wants; by another the slip u of a contact that
// never slides becomes u cos(pi sqrt(3.5 ratio (1 + (ln(e)/pi)^2))), e the normal restitution. For a smaller
// tangential restitution a dashpot stands beside it, and the spring is as much stiffer as keeps that time (S.
// Luding, Granular Matter 10, 235 (2008), for how a spring with a dashpot
// slides). Why the spring's force alone: the dashpot jumps at touch and pulls at the end, which a sliding
// limit would see, while over the whole contact its impulse is zero. So what slides throughout takes exactly
// mu times the normal impulse, and with equal periods what sticks sticks throughout: slip ratios are those of
// the impulse law to 0.05 for restitutions of 0.75 and 0.1 for 0.5, at any tangential restitution. With the
// dashpot in the limit they are off by up to 0.2 and 0.4 where sticking turns into sliding.
#pragma once
#include "contact.hpp"

namespace shakedown {

/// Tells whether surfaces of its kind have friction; where they have none there is no spring, and nothing is
/// stored.
bool rubs(const ContactModel& model, const Contact& contact);

/// Returns the energy stored in the tangential spring, J.
double energy_of_stretch(const ContactModel& model, const Contact& contact);

/// Returns the velocity of i relative to j at their point of contact, across the normal, m/s.
Vec3 slip_velocity(const Bodies& bodies, const Contact& contact);

/// Turns the spring into the new tangent plane, keeping its length, and stretches it by the slip during
/// `time` seconds.
void stretch_tangentially(const Bodies& bodies, double time, Contact& contact);

/// Sets the tangential force for the current velocities.
void set_friction(const ContactModel& model, const Bodies& bodies, Contact& contact);

/// Sets, after the last evaluation, the stretch of a spring that slides to what its share of the force stands
/// for.
void let_slide(const ContactModel& model, const Bodies& bodies, Contact& contact);

/// Return the distance from the centre of i, and of j, to the point of contact, m. The levers of a pair add
/// up to the distance of the centres, so that friction conserves angular momentum.
double lever_of_first(const Bodies& bodies, const Contact& contact);
double lever_of_second(const Bodies& bodies, const Contact& contact);

}  // namespace shakedown
