// SPDX-License-Identifier: MIT
// Rolling resistance: a torque of constant size against the relative rolling, mu_r R F_n with the reduced
// radius R and the force F_n of the normal spring ("type A" of J. Ai, J.-F. Chen, J. M. Rotter and J. Y. Ooi,
// Powder Technology 206, 269 (2011)). A torque of that size would chase the rolling to and fro once it has
// stopped; so no half kick takes more than a quarter of it, which leaves 0.3 % after the ten steps that are
// half a contact, and is steady with up to eight contacts of a grain. The force of the dashpot has no
// impulse over a whole contact, so the angular impulse is mu_r R times that of the normal, as hard impacts
// have it.
#pragma once
#include "contact.hpp"

namespace shakedown {

/// Returns the torque on i, N m; j gets the opposite. `spin`: rad/s of all bodies at the beginning of the
/// half kick of `half_step` seconds.
Vec3 rolling_torque(const ContactModel& model, const Bodies& bodies, const Contact& contact,
                    const Bodies::Rows& spin, double half_step);

}  // namespace shakedown
