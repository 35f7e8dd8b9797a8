// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "known_effects.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "suggestion.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

using Known = std::span<const EffectRecord* const>;

[[noreturn]] void refuse(std::string_view key, std::string problem, std::string remedy) {
  throw InputError({{{}, std::string(key), std::move(problem), std::move(remedy)}});
}

/// "effect.parameter" or "effect.parameter.x" taken apart.
struct EffectPath {
  const EffectRecord* record = nullptr;
  const Parameter* parameter = nullptr;
  int axis = -1;
};

const EffectRecord* record_named(const Setup& setup, std::string_view name, Known known) {
  const EffectChoice* choice = find_choice(setup, name);
  return choice ? choice->record : find_record(known, name);
}

[[noreturn]] void unknown(const Setup& setup, std::string_view key, Known known) {
  std::vector<std::string> paths;
  for (const SetupKey& candidate : setup_keys())
    if (is_numeric(candidate)) paths.emplace_back(candidate.path);
  const auto add = [&](const EffectRecord& record) {
    for (const Parameter& parameter : record.parameters)
      if (parameter.kind == ParameterKind::number || parameter.kind == ParameterKind::vector)
        paths.push_back(std::string(record.name) + "." + std::string(parameter.name) +
                        (parameter.kind == ParameterKind::vector ? ".x" : ""));
  };
  for (const EffectRecord* record : known) add(*record);
  for (const EffectChoice& choice : setup.effects) add(*choice.record);
  const std::vector<std::string_view> candidates(paths.begin(), paths.end());
  const std::string_view near = nearest(key, candidates);
  refuse(key, "is not a numeric key of a setup or of an effect",
         near.empty() ? "`shakedown schema` lists the keys, `shakedown effects` the effects"
                      : "did you mean " + std::string(near) + "?");
}

EffectPath effect_path(const Setup& setup, std::string_view key, Known known) {
  EffectPath path;
  const std::size_t dot = key.find('.');
  if (dot == key.npos) unknown(setup, key, known);
  path.record = record_named(setup, key.substr(0, dot), known);
  std::string_view parameter = key.substr(dot + 1);
  if (path.record != nullptr) path.parameter = path.record->find(parameter);
  if (path.record != nullptr && path.parameter == nullptr && parameter.size() > 2 &&
      parameter[parameter.size() - 2] == '.') {
    const char axis = parameter.back();
    path.axis = axis >= 'x' && axis <= 'z' ? axis - 'x' : -1;
    path.parameter = path.record->find(parameter.substr(0, parameter.size() - 2));
  }
  if (path.parameter == nullptr) unknown(setup, key, known);
  const bool number = path.parameter->kind == ParameterKind::number && path.axis < 0;
  const bool component = path.parameter->kind == ParameterKind::vector && path.axis >= 0;
  if (path.parameter->kind == ParameterKind::vector && path.axis < 0)
    refuse(key, "is a vector (a number sets one component)", "add .x, .y or .z");
  if (!number && !component) unknown(setup, key, known);
  return path;
}

void check(std::string_view key, double value, double low, double high, bool low_excluded,
           std::string_view unit) {
  const std::string problem = out_of_bounds(value, low, high, low_excluded, unit);
  if (!problem.empty()) refuse(key, problem, "choose a value within the bounds");
}

void store(Setup& setup, const SetupKey& key, double value) {
  std::visit(
      [&](auto field) {
        using T = std::remove_reference_t<decltype(field(setup))>;
        if constexpr (std::is_same_v<T, std::array<double, 2>>) {
          field(setup) = {value, value};
        } else if constexpr (std::is_same_v<T, double>) {
          field(setup) = value;
        } else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, std::uint64_t>) {
          if (value != std::floor(value)) refuse(key.path, "is not a whole number", "choose a whole number");
          field(setup) = static_cast<T>(value);
        } else {
          refuse(key.path, "is not a number", "set it in the setup file");
        }
      },
      key.field);
}

double component_of(const ParameterValue& value, int axis) {
  return axis < 0 ? std::get<double>(value) : std::get<Vec3>(value)[axis];
}

}  // namespace

void set_number(Setup& setup, std::string_view key, double value, Known known) {
  if (const SetupKey* found = find_setup_key(key)) {
    if (is_numeric(*found)) check(key, value, found->low, found->high, found->low_excluded, found->unit);
    return store(setup, *found, value);
  }
  const EffectPath path = effect_path(setup, key, known);
  check(key, value, path.parameter->low, path.parameter->high, false, path.parameter->unit);
  auto choice = std::find_if(setup.effects.begin(), setup.effects.end(),
                             [&](const EffectChoice& candidate) { return candidate.record == path.record; });
  if (choice == setup.effects.end())
    choice = setup.effects.insert(setup.effects.end(), with_defaults(*path.record));
  ParameterValue& stored = choice->values.find(path.parameter->name)->second;
  (path.axis < 0 ? std::get<double>(stored) : std::get<Vec3>(stored)[path.axis]) = value;
}

double get_number(const Setup& setup, std::string_view key, Known known) {
  if (const SetupKey* found = find_setup_key(key)) {
    if (!is_numeric(*found)) refuse(key, "is not a number", "ask for a numeric key");
    return numbers_of(*found, setup).front();
  }
  const EffectPath path = effect_path(setup, key, known);
  for (const EffectChoice& choice : setup.effects)
    if (choice.record == path.record)
      return component_of(choice.values.find(path.parameter->name)->second, path.axis);
  return std::isnan(path.parameter->neutral) ? component_of(path.parameter->default_value, path.axis)
                                             : path.parameter->neutral;
}

}  // namespace shakedown
