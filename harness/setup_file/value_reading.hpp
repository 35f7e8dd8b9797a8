// SPDX-License-Identifier: MIT
// Turns values of a TOML file into numbers in SI, or says what is wrong with them.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "effect.hpp"
#include "toml_document.hpp"

namespace shakedown {

/// Why a value cannot be taken, and what to do.
struct Problem {
  std::string problem, remedy;
};
template <class T>
using ValueOrProblem = std::variant<T, Problem>;

/// Reads a quantity with the dimension of `unit`, in SI; without a unit a bare number or a text as "5 %".
/// `unit` serves as the example in remedies.
ValueOrProblem<double> number_in(const TomlValue& value, std::string_view unit);

/// Reads a whole number between 0 and `high`.
ValueOrProblem<std::int64_t> count_in(const TomlValue& value, double high);

/// Reads one of the words.
ValueOrProblem<std::string> choice_in(const TomlValue& value, std::span<const std::string_view> choices);

/// Read the value as a text, and as true or false; a problem where it is of another type.
ValueOrProblem<std::string> text_in(const TomlValue& value);
ValueOrProblem<bool> boolean_in(const TomlValue& value);

/// Reads a parameter of an effect, by its kind.
ValueOrProblem<ParameterValue> parameter_in(const TomlValue& value, const Parameter& parameter);

/// Returns the reason why a number is out of bounds, or nothing: `is -434 g (must be greater than 0 g)`.
std::string out_of_bounds(double si, double low, double high, bool low_excluded, std::string_view unit);

}  // namespace shakedown
