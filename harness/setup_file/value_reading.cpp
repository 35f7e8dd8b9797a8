// SPDX-License-Identifier: MIT
#include "value_reading.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "quantity.hpp"
#include "suggestion.hpp"

namespace shakedown {

namespace {

Unit unit_of(std::string_view text) {
  const ValueOrReason<Unit> unit = parse_unit(text);
  EXPECT(std::holds_alternative<Unit>(unit));
  return std::get<Unit>(unit);
}

std::string example(std::string_view unit) {
  return unit.empty() ? "write a number without quotation marks, e.g. 0.5"
                      : "write a number and a unit in quotation marks, e.g. \"1 " + std::string(unit) + "\"";
}

ValueOrProblem<double> quantity_in(const std::string& text, std::string_view unit) {
  const ValueOrReason<Quantity> parsed = parse_quantity(text);
  if (const auto* reason = std::get_if<std::string>(&parsed))
    return Problem{toml_string(text) + " " + *reason, example(unit)};
  const Quantity& quantity = std::get<Quantity>(parsed);
  const Dimension wanted = unit_of(unit).dimension;
  if (quantity.dimension == wanted) return quantity.si;
  if (quantity.dimension == Dimension{})
    return Problem{toml_string(text) + " has no unit (" + describe(wanted) + " is expected)", example(unit)};
  return Problem{toml_string(text) + " has the wrong unit (it is " + describe(quantity.dimension) + ", " +
                     describe(wanted) + " is expected)",
                 example(unit)};
}

Problem wrong_kind(const TomlValue& value, std::string_view wanted, std::string remedy) {
  return {"is " + std::string(describe(value.kind)) + " (" + std::string(wanted) + " is expected)",
          std::move(remedy)};
}

const TomlValue* component(const TomlValue& value, int axis) {
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  if (value.kind == TomlValue::Kind::array)
    return static_cast<std::size_t>(axis) < value.items.size() ? &value.items[static_cast<std::size_t>(axis)]
                                                               : nullptr;
  return value.find(axes[static_cast<std::size_t>(axis)]);
}

ValueOrProblem<ParameterValue> vector_in(const TomlValue& value, std::string_view unit) {
  const std::string one = unit.empty() ? "0.1" : "\"0.1 " + std::string(unit) + "\"";
  const std::string remedy = "write [" + one + ", " + one + ", " + one +
                             "], or name the components that are not 0: {x = " + one + "}";
  if (value.kind != TomlValue::Kind::array && value.kind != TomlValue::Kind::table)
    return wrong_kind(value, "three components", remedy);
  if (value.kind == TomlValue::Kind::array && value.items.size() != 3)
    return Problem{"has " + std::to_string(value.items.size()) + " components (three are expected)", remedy};
  for (const TomlEntry& entry : value.entries)
    if (entry.key != "x" && entry.key != "y" && entry.key != "z")
      return Problem{"has the unknown component '" + entry.key + "' (x, y and z are known)", remedy};
  Vec3 vector = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const TomlValue* item = component(value, axis);
    if (item == nullptr) continue;
    const ValueOrProblem<double> number = number_in(*item, unit);
    if (const auto* problem = std::get_if<Problem>(&number)) return *problem;
    vector[axis] = std::get<double>(number);
  }
  return ParameterValue(vector);
}

ValueOrProblem<ParameterValue> constants_in(const TomlValue& value) {
  const std::string remedy = "write {c = \"0.4 N s/m\", w = \"12 mm\"}";
  if (value.kind != TomlValue::Kind::table) return wrong_kind(value, "a table of named quantities", remedy);
  std::map<std::string, double> constants;
  for (const TomlEntry& entry : value.entries) {
    if (entry.value.kind == TomlValue::Kind::text) {
      const ValueOrReason<Quantity> parsed = parse_quantity(entry.value.text);
      if (const auto* reason = std::get_if<std::string>(&parsed))
        return Problem{entry.key + " = " + toml_string(entry.value.text) + " " + *reason, remedy};
      constants[entry.key] = std::get<Quantity>(parsed).si;
      continue;
    }
    const ValueOrProblem<double> number = number_in(entry.value, "");
    if (const auto* problem = std::get_if<Problem>(&number))
      return Problem{entry.key + " " + problem->problem, remedy};
    constants[entry.key] = std::get<double>(number);
  }
  return ParameterValue(constants);
}

template <class T>
ValueOrProblem<ParameterValue> widened(const ValueOrProblem<T>& value) {
  if (const auto* problem = std::get_if<Problem>(&value)) return *problem;
  return ParameterValue(std::get<T>(value));
}

/// Shows a bare number with its SI unit and with the usual one: only its writer knows which is meant, and a
/// wrong one is a thousandfold error.
std::string with_units(double number, std::string_view unit) {
  const std::string words = describe(unit_of(unit).dimension);  // "a mass (kg)"
  const std::size_t open = words.find('(');
  std::string si = open == std::string::npos ? "" : words.substr(open + 1, words.size() - open - 2);
  if (si == unit) si.clear();
  std::string text;
  for (const std::string_view one : {std::string_view(si), unit})
    if (!one.empty())
      text += (text.empty() ? ": \"" : " or \"") + write_number(number) + " " + std::string(one) + "\"";
  return text;
}

}  // namespace

ValueOrProblem<double> number_in(const TomlValue& value, std::string_view unit) {
  const bool bare = value.kind == TomlValue::Kind::integer || value.kind == TomlValue::Kind::number;
  if (bare && !std::isfinite(value.number)) return Problem{"is not a finite number", example(unit)};
  if (bare && unit.empty()) return value.number;
  if (bare)
    return Problem{"is the bare number " + write_number(value.number) + " (" +
                       describe(unit_of(unit).dimension) + " is expected)",
                   "write the unit that it has" + with_units(value.number, unit)};
  if (value.kind == TomlValue::Kind::text) return quantity_in(value.text, unit);
  return wrong_kind(value, describe(unit_of(unit).dimension), example(unit));
}

ValueOrProblem<std::int64_t> count_in(const TomlValue& value, double high) {
  const std::string remedy =
      "write a whole number from 0 to " + write_number(high) + " without quotation marks";
  std::int64_t count = value.integer;
  if (value.kind == TomlValue::Kind::number && std::isfinite(value.number) &&
      value.number == std::floor(value.number) && std::abs(value.number) < 9e15)
    count = static_cast<std::int64_t>(value.number);  // 1e6
  else if (value.kind != TomlValue::Kind::integer)
    return wrong_kind(value, "a whole number", remedy);
  if (count < 0 || static_cast<double>(count) > high)
    return Problem{"is " + std::to_string(count) + " (it must lie between 0 and " + write_number(high) + ")",
                   remedy};
  return count;
}

ValueOrProblem<std::string> choice_in(const TomlValue& value, std::span<const std::string_view> choices) {
  const std::string words = listed(choices);
  if (value.kind != TomlValue::Kind::text)
    return wrong_kind(value, "one of the words " + words, "write one in quotation marks");
  if (std::find(choices.begin(), choices.end(), value.text) != choices.end()) return value.text;
  const std::string_view near = nearest(value.text, choices);
  return Problem{toml_string(value.text) + " is not known (one of " + words + " is expected)",
                 near.empty() ? "choose one of them" : "did you mean " + toml_string(near) + "?"};
}

ValueOrProblem<std::string> text_in(const TomlValue& value) {
  if (value.kind != TomlValue::Kind::text) return wrong_kind(value, "a text", "put it in quotation marks");
  return value.text;
}

ValueOrProblem<bool> boolean_in(const TomlValue& value) {
  if (value.kind != TomlValue::Kind::boolean)
    return wrong_kind(value, "true or false", "write true or false without quotation marks");
  return value.boolean;
}

ValueOrProblem<ParameterValue> parameter_in(const TomlValue& value, const Parameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::number: return widened(number_in(value, parameter.unit));
    case ParameterKind::vector: return vector_in(value, parameter.unit);
    case ParameterKind::choice: return widened(choice_in(value, parameter.choices));
    case ParameterKind::text: return widened(text_in(value));
    case ParameterKind::constants: return constants_in(value);
  }
  EXPECT(false);
  return Problem{};
}

std::string out_of_bounds(double si, double low, double high, bool low_excluded, std::string_view unit) {
  if (!std::isfinite(si)) return "is not a finite number";
  if ((low_excluded ? si > low : si >= low) && si <= high) return "";
  const std::string value = "is " + write_quantity(si, unit);
  if (low_excluded && si <= low)
    return value + " (it must be greater than " + write_quantity(low, unit) + ")";
  if (!std::isfinite(high)) return value + " (it must be at least " + write_quantity(low, unit) + ")";
  if (!std::isfinite(low)) return value + " (it must be at most " + write_quantity(high, unit) + ")";
  return value + " (it must lie between " + write_quantity(low, unit) + " and " + write_quantity(high, unit) +
         ")";
}

}  // namespace shakedown
