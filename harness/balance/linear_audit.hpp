// SPDX-License-Identifier: MIT
// Audits the momentum balance, linear about what camera and weights were read with.
#pragma once
#include "balance_problem.hpp"
#include "known_effects.hpp"
#include "momentum.hpp"

namespace shakedown {

/// Audits the balance of a measurement that was read with `already` (read_with()).
MomentumAudit linear_audit(const Measurement& measurement, KnownEffects known, const MomentumOptions& options,
                           const NuisanceValues& already);

/// Sorts the terms: what explains most stands first; sines behind all others, for what is left of any law
/// looks like one.
void by_what_they_explain(std::vector<FoundTerm>& terms);

}  // namespace shakedown
