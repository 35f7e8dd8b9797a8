// SPDX-License-Identifier: MIT
#pragma once

#include "execution.hpp"
#include "measured_against_model.hpp"

namespace shakedown {

/// Returns the curves of a report: each run as measured, beside the setup as `given` (null: none) and the
/// final one. Throws Interrupted.
std::vector<MeasuredAgainstModel> drawn_curves(const Measurement& measurement, const Setup* given,
                                               const Setup& final_setup, const Engine& engine,
                                               const Execution& execution);

}  // namespace shakedown
