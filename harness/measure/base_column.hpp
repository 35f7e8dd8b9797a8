// SPDX-License-Identifier: MIT
// A run's column base_position goes into the run's setup as the effect base_motion, so that waveform, balance
// and engines take it without asking.
#pragma once
#include <string_view>
#include <utility>
#include <vector>

#include "experiment.hpp"

namespace shakedown {

constexpr std::string_view base_samples_key = "base_motion.samples", base_start_key = "base_motion.start";

/// Tells whether the run's base moves, so that it is driven.
bool is_driven(const MeasuredRun& run);

/// Adds the motion of the base to the run's overrides; `base`: times (s) and places (m).
void add_base_motion(const std::vector<std::pair<double, double>>& base, MeasuredRun& run);

}  // namespace shakedown
