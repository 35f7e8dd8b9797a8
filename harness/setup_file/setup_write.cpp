// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>

#include "fnv.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

std::string toml_of_vector(const Vec3& value, std::string_view unit) {
  return "[" + toml_of(value.x(), unit) + ", " + toml_of(value.y(), unit) + ", " + toml_of(value.z(), unit) +
         "]";
}

/// Writes constants in SI as bare numbers: what unit they had does not matter to the formula.
std::string toml_of_constants(const std::map<std::string, double>& constants) {
  std::string text;
  for (const auto& [name, value] : constants)
    text += (text.empty() ? "" : ", ") + (toml_string(name) + " = " + write_number(value));
  return "{" + text + "}";
}

std::string toml_of_parameter(const Parameter& parameter, const EffectChoice& choice) {
  switch (parameter.kind) {
    case ParameterKind::number: return toml_of(choice.number(parameter.name), parameter.unit);
    case ParameterKind::vector: return toml_of_vector(choice.vector(parameter.name), parameter.unit);
    case ParameterKind::constants: return toml_of_constants(choice.constants(parameter.name));
    case ParameterKind::choice:
    case ParameterKind::text: return toml_string(choice.text(parameter.name));
  }
  return "";
}

bool left_out(const SetupKey& key, const Setup& setup) {
  if (key.path == "release.initial_grains" && setup.release.initial_grains.empty()) return true;
  // An effect that stands for this key: both in one file would be a contradiction.
  return std::any_of(setup.effects.begin(), setup.effects.end(),
                     [&](const EffectChoice& choice) { return choice.record->claims == key.path; });
}

}  // namespace

std::string write_effect(const EffectChoice& choice) {
  std::string text = "\n[[effect]]\nname = " + toml_string(choice.record->name) + "\n";
  for (const Parameter& parameter : choice.record->parameters)
    if (parameter.becomes.empty())
      text += std::string(parameter.name) + " = " + toml_of_parameter(parameter, choice) + "\n";
  return text;
}

std::string write_setup(const Setup& setup) {
  std::string text;
  std::string_view section;
  for (const SetupKey& key : setup_keys()) {
    if (left_out(key, setup)) continue;
    if (key.section() != section) {
      section = key.section();
      text += (text.empty() ? "[" : "\n[") + std::string(section) + "]\n";
    }
    text += std::string(key.name()) + " = " + toml_of(key, setup) + "\n";
  }
  for (const EffectChoice& choice : setup.effects) text += write_effect(choice);
  return text;
}

std::string digest(const Setup& setup) {
  Setup bare = setup;
  std::erase_if(bare.effects, [](const EffectChoice& choice) { return is_neutral(choice); });
  std::ifstream grains(bare.release.initial_grains, std::ios::binary);
  if (!bare.release.initial_grains.empty() && grains) {
    const std::string contents(std::istreambuf_iterator<char>(grains), {});
    bare.release.initial_grains = "grains " + hexadecimal(fnv1a(contents));
    if (const std::optional<double>& at = bare.release.grains_measured_at)
      bare.release.initial_grains += " measured at " + write_quantity(*at, "m");
  }
  return hexadecimal(fnv1a(write_setup(bare)));
}

}  // namespace shakedown
