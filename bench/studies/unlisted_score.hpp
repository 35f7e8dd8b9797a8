// SPDX-License-Identifier: MIT
// Forces that no list of effects has, as a blind suite scores them.
#pragma once
#include <vector>

#include "opened_case.hpp"
#include "score_table.hpp"

namespace shakedown {

/// Told as such; and of those whose form a diagnosis can offer whether it was offered. The hidden force and
/// those offered are compared along the motion that the model of `tools` makes of the truth.
void unlisted_forces(const std::vector<OpenedCase>& cases, const TrialTools& tools, ScoreTable& table);

}  // namespace shakedown
