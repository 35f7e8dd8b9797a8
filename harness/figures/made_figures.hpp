// SPDX-License-Identifier: MIT
// Each kind of figure, from the JSON of a command.
#pragma once
#include <nlohmann/json.hpp>

#include "result_figures.hpp"

namespace shakedown {

using Json = nlohmann::ordered_json;

/// Positions of each run beside the model, or the peaks of a simulation with a straight line and an
/// exponential. Throws InputError for a run that the result has not; these all throw nlohmann::json's
/// exceptions where the result is not as the program writes it.
Figure decay_figure(const Json& result, const FigureRequest& request);
/// Measured less model, with two expected spreads.
Figure residuals_figure(const Json& result, const FigureRequest& request);
/// Error of the box step by step.
Figure ladder_figure(const Json& result);
/// Over time, or what each class of contact took in the end.
Figure energy_figure(const Json& result, const FigureRequest& request);
/// Of hypotheses, or of the laws of a restitution.
Figure probabilities_figure(const Json& result);
/// Against the speed of impact.
Figure restitution_figure(const Json& result);

/// The plots of energy over time in a stored report.
std::vector<Json> energy_plots_of(const Json& report);

}  // namespace shakedown
