// SPDX-License-Identifier: MIT
#include "catalogue.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "effects.hpp"
#include "engine_differences.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

std::string padded(std::string_view text, std::size_t width) {
  return std::string(text) + std::string(width > text.size() ? width - text.size() : 0, ' ');
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t width = 100) {
  std::string result, line;
  const auto flush = [&] {
    result += (result.empty() ? "" : "\n" + std::string(indent, ' ')) + line;
    line.clear();
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (!line.empty() && indent + line.size() + word.size() + 1 > width) flush();
    (line += line.empty() ? "" : " ") += word;
    at = end + 1;
  }
  flush();
  return result;
}

/// Writes a value in its unit, "0.02 N", and infinities in words.
std::string in_unit(double value, std::string_view unit) {
  return std::isfinite(value) ? write_quantity(value, unit) : value > 0 ? "no limit" : "-no limit";
}

std::string bounds_of(const Parameter& parameter) {
  if (!std::isfinite(parameter.low) && !std::isfinite(parameter.high)) return "";
  return in_unit(parameter.low, parameter.unit) + " to " + in_unit(parameter.high, parameter.unit);
}

/// Returns a value of this strength as it stands in a setup file.
std::string toml_value(const Parameter& parameter, double strength) {
  switch (parameter.kind) {
    case ParameterKind::number: return toml_of(strength, parameter.unit);
    case ParameterKind::vector: return "{x = " + toml_of(strength, parameter.unit) + "}";
    case ParameterKind::choice: return toml_string(std::get<std::string>(parameter.default_value));
    case ParameterKind::text:
    case ParameterKind::constants: return std::string(parameter.example);
  }
  return "";
}

bool is_strength(const Parameter& parameter) {
  return parameter.kind == ParameterKind::number
             ? parameter.required || !std::isnan(parameter.neutral)
             : parameter.kind != ParameterKind::choice || parameter.required;
}

/// Says what the effect adds to the plain model:
/// "at 40 mm the slope changes by -0.62 mm/s, hard minus soft by 0.01 +- 0.03".
std::string differences_of(const EffectRecord& effect) {
  std::string text;
  for (const EngineDifference& row : engine_differences()) {
    if (row.effect != effect.name) continue;
    const AddedDifference added = *added_difference(row.effect, row.box_length);
    std::array<char, 160> part;
    std::snprintf(part.data(), part.size(),
                  "at %.0f mm the slope changes by %.2f mm/s, hard minus soft by %.2f +- %.2f",
                  1e3 * row.box_length, 1e3 * added.change, 1e3 * added.added, 1e3 * added.half_width);
    text += (text.empty() ? "measured at " + row.strength + ": " : "; ") + std::string(part.data());
  }
  return text;
}

/// Returns what the effect adds to the difference of the engines at both lengths that were measured, mm/s.
std::string shortly(std::string_view effect) {
  std::string text;
  for (const double length : {0.040, 0.104})
    if (const auto added = added_difference(effect, length)) {
      std::array<char, 32> part;
      std::snprintf(part.data(), part.size(), "%s%+.2f", text.empty() ? "" : " ", 1e3 * added->added);
      text += part.data();
    }
  return text.empty() ? "-" : text;
}

}  // namespace

std::string_view name_of(ActsOn acts_on) {
  constexpr std::array<std::string_view, 5> names{"contact", "grains", "box", "all", "camera"};
  return names[static_cast<std::size_t>(acts_on)];
}

std::string_view name_of(Fidelity fidelity) {
  constexpr std::array<std::string_view, 3> names{"exact", "to a stated error", "not modelled"};
  return names[static_cast<std::size_t>(fidelity)];
}

std::vector<std::string_view> engines_of(KnownEffects effects) {
  std::vector<std::string_view> engines;
  for (const EffectRecord* effect : effects)
    for (const EngineCapability& one : effect->engines)
      if (one.engine != every_engine &&
          std::find(engines.begin(), engines.end(), one.engine) == engines.end())
        engines.push_back(one.engine);
  return engines;
}

std::string list_effects(KnownEffects effects) {
  const auto mark = [](const Capability& capability) { return padded(name_of(capability.fidelity), 19); };
  std::string text = padded("effect", 32) + padded("acts on", 9);
  for (const std::string_view engine : engines_of(effects)) text += padded(engine, 19);
  text += padded("hard-soft*", 14) + "what it is\n";
  for (const EffectRecord* effect : effects) {
    text += padded(effect->name, 32) + padded(name_of(effect->acts_on), 9);
    for (const std::string_view engine : engines_of(effects)) text += mark(effect->capability(engine));
    text += padded(shortly(effect->name), 14) + std::string(effect->sentence) + "\n";
  }
  return text + "* of the slope, added by the effect at the strength measured, L = 40 and 104 mm, mm/s\n";
}

std::string example_of(const EffectRecord& effect) {
  std::string text = "[[effect]]\nname = " + toml_string(effect.name) + "\n";
  for (const Parameter& parameter : effect.parameters)
    if (parameter.becomes.empty() && (is_strength(parameter) || parameter.required))
      text += std::string(parameter.name) + " = " + toml_value(parameter, parameter.typical) + "\n";
  return text;
}

std::string describe_effect(const EffectRecord& effect) {
  std::string text = std::string(effect.name) + " (acts on: " + std::string(name_of(effect.acts_on)) + ")\n";
  const auto line = [&](std::string_view title, std::string_view body) {
    if (!body.empty()) text += "  " + padded(title, 10) + wrapped(body, 12) + "\n";
  };
  line("", effect.sentence);
  line("formula", effect.formula);
  line("limits", effect.limits);
  line("source", effect.source);
  line("replaces", effect.claims);
  line("needs", effect.needs);
  const auto capability = [&](std::string_view engine, const Capability& of) {
    line(engine, std::string(name_of(of.fidelity)) + (of.note.empty() ? "" : ": " + std::string(of.note)));
  };
  for (const std::string_view engine : engines_of(all_effects()))
    capability(engine, effect.capability(engine));
  line("engines", differences_of(effect));
  for (const Parameter& parameter : effect.parameters) {
    text += "  parameter " + std::string(parameter.name) + (parameter.required ? " (required)" : "") + "\n";
    std::string facts(parameter.sentence);
    if (parameter.kind == ParameterKind::choice) {
      facts += " One of:";
      for (const std::string_view word : parameter.choices) facts += " " + std::string(word);
      facts += "; default " + std::get<std::string>(parameter.default_value) + ".";
    }
    if (const std::string bounds = bounds_of(parameter); !bounds.empty()) facts += " Bounds: " + bounds + ".";
    if (const auto* value = std::get_if<double>(&parameter.default_value);
        value != nullptr && !parameter.required)
      facts += " Default: " + write_quantity(*value, parameter.unit) + ".";
    const bool numeric = parameter.kind == ParameterKind::number || parameter.kind == ParameterKind::vector;
    if (numeric)
      facts += std::isnan(parameter.neutral)
                   ? " No neutral value."
                   : " Absent at " + write_quantity(parameter.neutral, parameter.unit) + ".";
    text += "            " + wrapped(facts, 12) + "\n";
  }
  text += "  in a setup:\n";
  const std::string example = example_of(effect);
  for (std::size_t at = 0; at < example.size();) {
    const std::size_t end = example.find('\n', at);
    text += "    " + example.substr(at, end - at + 1);
    at = end + 1;
  }
  return text;
}

std::string setup_keys_markdown() {
  std::string text = "| key | default | bounds | meaning |\n|---|---|---|---|\n";
  for (const SetupKey& key : setup_keys()) {
    std::string bounds;
    if (is_numeric(key) && std::isfinite(key.low))
      bounds = (key.low_excluded ? "> " : ">= ") + write_quantity(key.low, key.unit);
    if (is_numeric(key) && std::isfinite(key.high))
      bounds += (bounds.empty() ? "<= " : ", <= ") + write_quantity(key.high, key.unit);
    if (const auto choices = choices_of(key); !choices.empty())
      for (const std::string_view word : choices) (bounds += bounds.empty() ? "" : ", ") += word;
    text += "| `" + std::string(key.path) + "` | `" + toml_of(key, Setup{}) + "` | " + bounds + " | " +
            std::string(key.sentence) + " |\n";
  }
  return text;
}

}  // namespace shakedown
