// SPDX-License-Identifier: MIT
// Tells when a formula is no answer: it foretells nothing, or it imitates a known force. By cross-validation
// (Stone, J. R. Stat. Soc. B 36, 111 (1974)) a formula that no effect describes is offered only where it
// foretells stretches of the measurement that its strengths were not fitted to.
#pragma once
#include <vector>

#include "balance_evidence.hpp"

namespace shakedown {

/// Returns chi2 of the windows left out, each stretch foretold by strengths fitted to all others. Stretches
/// are the runs, or the two halves in time of a single run. Shape parameters stay as they are. Returns no
/// number where a stretch cannot be foretold.
double chi2_foretold(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

/// Share of the formulas' gain that a known force must bring in their place to be what they imitate:
/// |v|^1.5, half way between linear and quadratic damping, shares 0.99 with either (squared correlation of
/// |v|^p sign v over a swing), and the two themselves 0.96.
constexpr double imitated = 0.99;

/// Tells whether the formulas of the selection imitate a known force, so that no force of no list acts. False
/// without formulas.
bool imitates_known(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

}  // namespace shakedown
