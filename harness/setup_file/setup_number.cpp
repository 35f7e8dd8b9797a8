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

using Known = KnownEffects;

[[noreturn]] void refuse(std::string_view key, std::string problem, std::string remedy) {
  throw InputError({{{}, std::string(key), std::move(problem), std::move(remedy)}});
}

/// "effect.parameter", "effect.parameter.x" or "effect.constants.name" taken apart.
struct EffectPath {
  const EffectRecord* record = nullptr;
  const Parameter* parameter = nullptr;
  int axis = -1;
  std::string constant{};
};

const EffectRecord* record_named(const Setup& setup, std::string_view name, Known known) {
  const EffectChoice* choice = find_choice(setup, name);
  return choice ? choice->record : known.find(name);
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

/// Returns the path with the constant of a formula, which the setup's own effect has and no record can know.
EffectPath constant_path(const Setup& setup, std::string_view key, EffectPath path) {
  const EffectChoice* choice = find_choice(setup, path.record->name);
  path.constant = key.substr(path.record->name.size() + path.parameter->name.size() + 2);
  std::vector<std::string_view> names;
  if (choice != nullptr)
    for (const auto& [name, value] : choice->constants(path.parameter->name)) names.emplace_back(name);
  if (std::find(names.begin(), names.end(), path.constant) != names.end()) return path;
  refuse(key, "is no constant that the setup gives this formula",
         names.empty() ? "give it in the setup, e.g. constants = {" + path.constant + " = 1}"
                       : "it has " + listed(names));
}

EffectPath effect_path(const Setup& setup, std::string_view key, Known known) {
  EffectPath path;
  const std::size_t dot = key.find('.');
  if (dot == key.npos) unknown(setup, key, known);
  path.record = record_named(setup, key.substr(0, dot), known);
  std::string_view parameter = key.substr(dot + 1);
  if (path.record != nullptr) path.parameter = path.record->find(parameter);
  const std::size_t second_dot = parameter.find('.');
  if (path.record != nullptr && path.parameter == nullptr && second_dot != parameter.npos) {
    const Parameter* table = path.record->find(parameter.substr(0, second_dot));
    if (table != nullptr && table->kind == ParameterKind::constants) {
      path.parameter = table;
      return constant_path(setup, key, std::move(path));
    }
  }
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

double& number_at(const EffectPath& path, ParameterValue& value) {
  if (!path.constant.empty()) return std::get<std::map<std::string, double>>(value).at(path.constant);
  return path.axis < 0 ? std::get<double>(value) : std::get<Vec3>(value)[path.axis];
}

double number_at(const EffectPath& path, ParameterValue&& value) { return number_at(path, value); }

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
  number_at(path, choice->values.find(path.parameter->name)->second) = value;
}

double get_number(const Setup& setup, std::string_view key, Known known) {
  if (const SetupKey* found = find_setup_key(key)) {
    if (!is_numeric(*found)) refuse(key, "is not a number", "ask for a numeric key");
    return numbers_of(*found, setup).front();
  }
  const EffectPath path = effect_path(setup, key, known);
  for (const EffectChoice& choice : setup.effects)
    if (choice.record == path.record)
      return number_at(path, ParameterValue(choice.values.find(path.parameter->name)->second));
  return std::isnan(path.parameter->neutral) ? number_at(path, ParameterValue(path.parameter->default_value))
                                             : path.parameter->neutral;
}

}  // namespace shakedown
