// SPDX-License-Identifier: MIT
// Between kicks the grains fly on straight lines, bent by accelerations that are the same for all of them.
#pragma once
#include "accounts.hpp"
#include "bodies.hpp"

namespace shakedown {

/// Moves the grains from `time` by `step` under constant and harmonic accelerations, in closed form.
void advance_grains(const GrainForces& forces, double time, double step, Bodies& bodies, Accounts& accounts);

/// Gives the grains the transverse velocity that they pick up as seen from a box on an arc: the box goes
/// across as 3/5 x^2 / l, so they pick up -6/5 (x v) / l. `before`: x v of the box when this was last done,
/// m^2/s.
void follow_arc(const GrainForces& forces, double before, Bodies& bodies, Accounts& accounts);

}  // namespace shakedown
