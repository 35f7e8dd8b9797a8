// SPDX-License-Identifier: MIT
// Where a run's column base_position goes: into the run's setup as the effect base_motion, so that waveform,
// balance and engines take it without asking.
#pragma once
#include <string_view>
#include <utility>
#include <vector>

#include "experiment.hpp"

namespace shakedown {

constexpr std::string_view base_samples_key = "base_motion.samples", base_start_key = "base_motion.start";

/// The run's base moves: it is driven.
bool is_driven(const MeasuredRun& run);

/// Adds the override; `base`: times (s) and places (m).
void add_base_motion(const std::vector<std::pair<double, double>>& base, MeasuredRun& run);

}  // namespace shakedown
