// SPDX-License-Identifier: MIT
// When a formula is no answer: it foretells nothing, or it imitates a known force.
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

/// Share of the formulas' gain that a known force must bring in their place to be what they imitate:
/// |v|^1.5, half way between linear and quadratic damping, shares 0.99 with either (squared correlation of
/// |v|^p sign v over a swing), and the two themselves 0.96.
constexpr double imitated = 0.99;

/// The formulas of the selection imitate a known force: no force of no list acts. False without formulas.
bool imitates_known(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

}  // namespace shakedown
