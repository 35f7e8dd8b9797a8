// SPDX-License-Identifier: MIT
// The grains between kicks: straight lines, bent by accelerations that are the same for all of them.
#pragma once
#include "accounts.hpp"
#include "bodies.hpp"

namespace shakedown {

/// Moves the grains from `time` by `step` under constant and harmonic accelerations, in closed form.
void advance_grains(const GrainForces& forces, double time, double step, Bodies& bodies, Accounts& accounts);

/// A box that follows an arc goes across as 3/5 x^2 / l, so grains seen from it pick up -6/5 (x v) / l of
/// transverse velocity. Enters the change of x v of the box since `before`.
void follow_arc(const GrainForces& forces, double before, Bodies& bodies, Accounts& accounts);

}  // namespace shakedown
