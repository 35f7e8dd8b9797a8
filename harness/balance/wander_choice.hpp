// SPDX-License-Identifier: MIT
#pragma once
#include "balance_evidence.hpp"

namespace shakedown {

/// m, that a track can wander by at most (balance_rules.hpp); `white`: standard deviation of a frame's noise.
double most_wander(const std::vector<MomentumRun>& runs, double white);

/// Between which frequencies an oscillating force may lie, Hz.
struct SineRange {
  double lowest = 0, highest = 0;
};

/// The wander of the track that makes the data most probable, whatever acts on the box: known strengths, and
/// a sine in this range, which a wander would take up. By a grid in strength (a factor of two) and memory. It
/// may come out larger than most_wander: then it is no tracker's. `white`: m, standard deviation of a frame's
/// noise.
void choose_wander(SelectionProblem& p, double white, const SineRange& sines);

}  // namespace shakedown
