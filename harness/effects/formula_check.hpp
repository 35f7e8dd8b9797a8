// SPDX-License-Identifier: MIT
// Finds what is wrong with a formula that a setup gives.
#pragma once
#include <functional>
#include <string_view>
#include <vector>

#include "effect.hpp"
#include "formula.hpp"

namespace shakedown {

/// A formula among an effect's parameters.
struct FormulaParameter {
  std::string_view name;       ///< of the parameter
  std::string_view may_use;    ///< "x (m), v (m/s), t (s)": its variables, for people
  std::string_view value_for;  ///< "every x, v and t": where it must have a value, for people
};

/// Reads the formula and asks whether it has a value where it is needed; `unsound`: a place where it has
/// none, in words, or empty. For EffectRecord::check.
std::vector<ParameterProblem> problems_of_formula(
    const FormulaParameter& parameter, const EffectChoice& choice,
    const std::function<std::string(const EffectChoice& choice)>& unsound);

}  // namespace shakedown
