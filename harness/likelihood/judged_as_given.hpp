// SPDX-License-Identifier: MIT
#pragma once
#include "measurement.hpp"
#include "refit.hpp"

namespace shakedown {

/// The model as the setup gives it beside these runs: nothing is fitted but camera and clock, within what is
/// known of them. `measured`: features_with_camera() of the measurement; `count`: simulations of each
/// different setup. Throws as refit() does.
Refit judged_as_given(const Setup& setup, const Measurement& measurement,
                      const std::vector<MeasuredFeatures>& measured, const Workshop& workshop, int count);

}  // namespace shakedown
