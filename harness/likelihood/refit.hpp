// SPDX-License-Identifier: MIT
// Fits parameters of a model to an experiment, through emulators: by generalised least squares with the
// covariance of the chaos, the camera's noise and the emulator's own error. Pseudo-experiments drawn from
// simulations that the covariance has not seen tell whether what remains is within the model's spread.
#pragma once
#include <vector>

#include "refit_options.hpp"
#include "refit_result.hpp"

namespace shakedown {

/// Fits the knobs (none: the setup as it is). Where simulations are refused (SimulationMeter::ask_for) once
/// there is a solution, that solution is the answer; before, BudgetSpent passes through. `measured` may leave
/// runs out; compare_at() then judges them.
Refit refit(const std::vector<MeasuredFeatures>& measured, std::vector<Knob> knobs, const Workshop& workshop,
            const RefitOptions& options);

/// Does what RefitOptions::look_beside_below asks for a fit of the same runs that was made without it, and
/// returns the best.
Refit look_beside(const Refit& fit, const std::vector<MeasuredFeatures>& measured, const Workshop& workshop,
                  const RefitOptions& options);

/// Compares the same measured runs, or others, with the model whose knobs stand at their centres; nothing is
/// fitted.
Refit compare_at(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                 const Workshop& workshop, const RefitOptions& options);

}  // namespace shakedown
