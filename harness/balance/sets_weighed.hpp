// SPDX-License-Identifier: MIT
// Finds which sets of strengths may act on the box, with windows, wander and sines that go with them.
#pragma once
#include <optional>
#include <vector>

#include "balance_problem.hpp"
#include "momentum.hpp"

namespace shakedown {

/// Holds the sets and what they were weighed by.
struct SetsWeighed {
  SelectionProblem problem;             ///< with the windows and the wander that the sets were weighed by
  std::vector<BalanceHypothesis> sets;  ///< most probable first; own noise not counted
  bool only_moving = false;             ///< windows at rest left out, because a dry friction sticks there
};

/// Weighs all sets. Returns nothing where there are too few windows. The result refers to `balance`.
std::optional<SetsWeighed> weigh_sets(const BalanceProblem& balance, const MomentumOptions& options);

}  // namespace shakedown
