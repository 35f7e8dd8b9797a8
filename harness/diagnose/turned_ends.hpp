// SPDX-License-Identifier: MIT
// Says how far the numbers of a page may be turned, and what a misfit is made of there.
#pragma once
#include "turned_numbers.hpp"

namespace shakedown {

/// Returns what a parameter can be at all, SI: the bounds of a comparison hardly let its numbers move.
std::pair<double, double> bounds_of(const TurnedNumber& number);

/// Fills in what is offered of each number. `knobs`: of the fit, in the order of its numbers.
void set_ends(TurnedModel& model, const std::vector<Knob>& knobs);

/// Returns TurnedModel::square of each run.
std::vector<Eigen::MatrixXd> squares_of(const TurnedModel& model, const EnsembleFit& fit);

}  // namespace shakedown
