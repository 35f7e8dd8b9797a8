// SPDX-License-Identifier: MIT
// The length or time that shapes a term (MomentumTerm::shape), found from the balance.
#pragma once
#include "balance_evidence.hpp"

namespace shakedown {

/// Moves the shape of each of the chosen terms to the best fit between the two values next to it that are
/// tried (or as far beyond the outermost), to 2 %. True if one was moved.
bool find_shapes(SelectionProblem& p, const std::vector<ChosenTerm>& chosen);

}  // namespace shakedown
