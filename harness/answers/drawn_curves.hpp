// SPDX-License-Identifier: MIT
#pragma once

#include "execution.hpp"
#include "last_fit.hpp"
#include "measured_against_model.hpp"

namespace shakedown {

/// Returns the curves of a report: each run as measured, beside the setup as `given` (null: none) and the
/// final one, which is filmed by the camera that `fit` has found (null: nothing was fitted), each run from
/// where it was let go. Throws Interrupted.
std::vector<MeasuredAgainstModel> drawn_curves(const Measurement& measurement, const Setup* given,
                                               const Setup& final_setup, const LastFit* fit,
                                               const Engine& engine, const Execution& execution);

}  // namespace shakedown
