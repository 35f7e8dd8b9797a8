// SPDX-License-Identifier: MIT
// Makes each kind of figure from the JSON of a command.
#pragma once
#include <nlohmann/json.hpp>

#include "figure.hpp"
#include "figure_request.hpp"

namespace shakedown {

using Json = nlohmann::ordered_json;

/// Draws positions of each run beside the model, or the peaks of a simulation with a straight line and an
/// exponential. Throws InputError for a run that the result has not; these all throw nlohmann::json's
/// exceptions where the result is not as the program writes it.
Figure decay_figure(const Json& result, const FigureRequest& request);
/// Draws measured less model, with two expected spreads.
Figure residuals_figure(const Json& result, const FigureRequest& request);
/// Draws the error of the box step by step.
Figure ladder_figure(const Json& result);
/// Draws the energy over time, or the final shares by class of contact and effect.
Figure energy_figure(const Json& result, const FigureRequest& request);
/// Draws the probabilities of hypotheses, or of the laws of a restitution.
Figure probabilities_figure(const Json& result);
/// Draws the restitution against the speed of impact.
Figure restitution_figure(const Json& result);

/// Returns the plots of energy over time in a stored report.
std::vector<Json> energy_plots_of(const Json& report);

}  // namespace shakedown
