// SPDX-License-Identifier: MIT
// Allows for what multiplies the whole balance and cannot be fitted in it: the scale of the camera, and the
// mass of a box without grains. Its error widens the intervals of the forces that it multiplies.
#pragma once
#include "balance_problem.hpp"
#include "known_effects.hpp"
#include "momentum.hpp"

namespace shakedown {

/// Widens the intervals of audit.terms. `measurement` is read with `already`. A linear damping does not
/// depend on the scale; dry friction grows with it, quadratic drag falls; all forces grow with an empty
/// box's mass.
void allow_for_scales(const Measurement& measurement, KnownEffects known, const NuisanceValues& already,
                      const MomentumOptions& options, MomentumAudit& audit);

}  // namespace shakedown
