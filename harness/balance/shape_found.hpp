// SPDX-License-Identifier: MIT
// Finds the length or time that shapes a term (MomentumTerm::shape) from the balance.
#pragma once
#include "balance_evidence.hpp"

namespace shakedown {

/// Moves the shape of each of the chosen terms to the best fit, to 2 %, as far to either side as the nearest
/// other value that is tried. Returns true if one was moved.
bool find_shapes(SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

}  // namespace shakedown
