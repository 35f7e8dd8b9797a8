// SPDX-License-Identifier: MIT
// Scores forces that no list of effects has.
#pragma once
#include <vector>

#include "opened_case.hpp"
#include "score_table.hpp"

namespace shakedown {

/// Adds how many were told as such, and of those whose form a diagnosis can offer how many were offered. The
/// hidden force and those offered are compared along the motion that the model of `tools` makes of the truth.
void unlisted_forces(const std::vector<OpenedCase>& cases, const TrialTools& tools, ScoreTable& table);

}  // namespace shakedown
