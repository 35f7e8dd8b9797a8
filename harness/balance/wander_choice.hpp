// SPDX-License-Identifier: MIT
#pragma once
#include "balance_evidence.hpp"

namespace shakedown {

/// Returns what a track can wander by at most, m (balance_rules.hpp); `white`: standard deviation of a
/// frame's noise, m.
double most_wander(const std::vector<MomentumRun>& runs, double white);

/// Sets the wander of the track that makes the data most probable, whatever acts on the box: by a grid in
/// strength (a factor of two) and memory. It may come out larger than most_wander: then it is no tracker's.
/// `white`: m, standard deviation of a frame's noise.
void choose_wander(SelectionProblem& p, double white);

/// Sets another strength of p's wander, by factors of two, or none, where that makes it and these forces, the
/// noise that they let in included, more probable; that noise then stays in p's covariance. Returns false
/// where it does not.
bool choose_wander_beside(SelectionProblem& p, double white, const std::vector<ChosenTerm>& acting);

}  // namespace shakedown
