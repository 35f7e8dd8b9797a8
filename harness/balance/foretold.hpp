// SPDX-License-Identifier: MIT
// Cross-validation (Stone, J. R. Stat. Soc. B 36, 111 (1974)): a formula that no effect describes is offered
// only where it foretells stretches of the measurement that its strengths were not fitted to.
#pragma once
#include <vector>

#include "balance_evidence.hpp"

namespace shakedown {

/// chi2 of the windows left out, each stretch foretold by strengths fitted to all others. Stretches: the
/// runs; of a single run its two halves in time. Shape parameters stay as they are. No number where a stretch
/// cannot be foretold.
double chi2_foretold(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

}  // namespace shakedown
