// SPDX-License-Identifier: MIT
// The momentum balance, linear about what camera and weights were read with.
#pragma once
#include "balance_problem.hpp"
#include "known_effects.hpp"
#include "momentum.hpp"

namespace shakedown {

/// `measurement` was read with `already` (read_with()).
MomentumAudit linear_audit(const Measurement& measurement, KnownEffects known, const MomentumOptions& options,
                           const NuisanceValues& already);

/// What explains most stands first; sines behind all others, for what is left of any law looks like one.
void by_what_they_explain(std::vector<FoundTerm>& terms);

}  // namespace shakedown
