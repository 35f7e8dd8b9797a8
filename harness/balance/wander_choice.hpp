// SPDX-License-Identifier: MIT
#pragma once
#include "balance_evidence.hpp"

namespace shakedown {

/// The wander of the track that makes the data most probable, whatever acts on the box: by a grid in strength
/// (a factor of two) and memory.
/// `white`: m, standard deviation of a frame's noise.
void choose_wander(SelectionProblem& p, double white);

}  // namespace shakedown
