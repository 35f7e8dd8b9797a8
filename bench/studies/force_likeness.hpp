// SPDX-License-Identifier: MIT
// Tells whether two formulas are the same force, as a damper feels it.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "formula.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// Returns a formula's values (N) along a motion. Throws FormulaProblem.
std::vector<double> force_along(const std::string& formula, const std::map<std::string, double>& constants,
                                const Trajectory& motion);

/// Returns |cos| of two series after a linear spring, a multiple of x, has been taken out of both: the
/// spring's frequency is refitted anyway. 0 when nothing is left of one.
double force_likeness(std::vector<double> a, std::vector<double> b, const std::vector<double>& x);

}  // namespace shakedown
