// SPDX-License-Identifier: MIT
#pragma once
#include "measurement.hpp"
#include "refit_result.hpp"

namespace shakedown {

/// Compares the model as the setup gives it with these runs: camera and clock are fitted within what is known
/// of them, parameters within what two codes of one physics differ by (as_given()). `measured`:
/// features_with_camera() of the measurement; `count`: simulations of each different setup. Throws as refit()
/// does.
Refit judged_as_given(const Setup& setup, const Measurement& measurement,
                      const std::vector<MeasuredFeatures>& measured, const Workshop& workshop, int count);

}  // namespace shakedown
