// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>

#include "catalogue.hpp"
#include "effect_strength.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

std::string_view name_of(ParameterKind kind) {
  constexpr std::array<std::string_view, 5> names{"number", "vector", "choice", "text", "constants"};
  return names[static_cast<std::size_t>(kind)];
}

Json json_of(const Parameter& parameter) {
  const bool numeric = parameter.kind == ParameterKind::number || parameter.kind == ParameterKind::vector;
  Json json{{"name", parameter.name},
            {"kind", name_of(parameter.kind)},
            {"meaning", parameter.sentence},
            {"required", parameter.required}};
  if (numeric) {
    json["unit"] = parameter.unit;
    if (!parameter.unit_shown.empty()) json["unit_shown"] = parameter.unit_shown;
    const auto number = [&](const char* key, double value) {
      json[key] = std::isfinite(value) ? Json(value) : Json();
    };
    if (const auto* value = std::get_if<double>(&parameter.default_value)) number("default", *value);
    if (const auto* vector = std::get_if<Vec3>(&parameter.default_value))
      json["default"] = {vector->x(), vector->y(), vector->z()};
    number("low", parameter.low);
    number("high", parameter.high);
    number("neutral", parameter.neutral);
    number("typical", parameter.typical);
  }
  if (parameter.kind == ParameterKind::choice) {
    json["choices"] = parameter.choices;
    json["default"] = std::get<std::string>(parameter.default_value);
  }
  return json;
}

Json json_of(const Capability& capability) {
  return {{"fidelity", name_of(capability.fidelity)}, {"note", capability.note}};
}

/// Returns the differences of the engines in mm/s at the strength measured, a row a box length; empty: not
/// measured, or seen by the camera only.
Json differences_json(const EffectRecord& effect) {
  Json rows = Json::array();
  for (const EngineDifference& row : engine_differences()) {
    if (row.effect != effect.name) continue;
    const AddedDifference added = *added_difference(row.effect, row.box_length);
    rows.push_back({{"strength", row.strength},
                    {"box_length_mm", 1e3 * row.box_length},
                    {"slope_mm_per_s", 1e3 * row.hard_slope},
                    {"hard_minus_soft_mm_per_s", 1e3 * row.hard_minus_soft},
                    {"half_width_95_mm_per_s", 1e3 * row.half_width},
                    {"slope_change_mm_per_s", 1e3 * added.change},
                    {"added_to_plain_model_mm_per_s", 1e3 * added.added},
                    {"added_half_width_95_mm_per_s", 1e3 * added.half_width}});
  }
  return rows;
}

Json json_of(const SearchedStrength& strength) {
  Json json{{"parameters", strength.parameters},
            {"typical", strength.typical},
            {"levels", strength.levels},
            {"low", strength.low},
            {"high", strength.high},
            {"strongest", strength.strongest}};
  if (!strength.absent_key.empty()) json["absent_key"] = strength.absent_key;
  if (strength.inverse) json["inverse"] = true;
  return json;
}

/// Returns how a diagnosis looks for it: strengths with their levels, or why it does not.
Json search_json(const EffectRecord& effect) {
  const Search search = search_of(effect);
  if (!search.not_searched.empty()) return {{"not_searched", search.not_searched}};
  Json strengths = Json::array();
  for (const SearchedStrength& strength : search.strengths) strengths.push_back(json_of(strength));
  return {{"strengths", strengths}, {"odds", search.odds}};
}

Json json_of(const EffectRecord& effect) {
  Json parameters = Json::array();
  for (const Parameter& parameter : effect.parameters) parameters.push_back(json_of(parameter));
  Json engines = Json::object();
  for (const std::string_view engine : engines_of(all_effects()))
    engines[std::string(engine)] = json_of(effect.capability(engine));
  return {{"name", effect.name},
          {"label", effect.label},
          {"family", family_of(effect)},
          {"acts_on", name_of(effect.acts_on)},
          {"sentence", effect.sentence},
          {"formula", effect.formula},
          {"source", effect.source},
          {"limits", effect.limits},
          {"replaces", effect.claims},
          {"needs", effect.needs},
          {"dissipative", effect.dissipative},
          {"parameters", parameters},
          {"engines", engines},
          {"search", search_json(effect)},
          {"hard_soft_difference", differences_json(effect)},
          {"example", example_of(effect)}};
}

// ---- schema ----

/// A number and a unit; the two micro signs are bytes of their own.
constexpr std::string_view quantity_pattern =
    "^\\s*[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?\\s*[A-Za-z%(/\u00b5\u03bc].*$";

Json quantity_schema(std::string_view unit, double low, double high, bool low_excluded) {
  if (!unit.empty())
    return {{"type", "string"},
            {"pattern", quantity_pattern},
            {"examples", Json::array({"1 " + std::string(unit)})}};
  Json json{{"type", "number"}};
  if (std::isfinite(low)) json[low_excluded ? "exclusiveMinimum" : "minimum"] = low;
  if (std::isfinite(high)) json["maximum"] = high;
  return json;
}

Json schema_of(const SetupKey& key) {
  Json json;
  const auto choices = choices_of(key);
  const Json one = quantity_schema(key.unit, key.low, key.high, key.low_excluded);
  if (!choices.empty())
    json = {{"enum", choices}};
  else if (std::holds_alternative<Field<bool>>(key.field))
    json = {{"type", "boolean"}};
  else if (std::holds_alternative<Field<std::string>>(key.field))
    json = {{"type", "string"}};
  else if (std::holds_alternative<Field<std::array<double, 2>>>(key.field))
    json = {
        {"oneOf", Json::array({one, {{"type", "array"}, {"items", one}, {"minItems", 2}, {"maxItems", 2}}})}};
  else
    json = one;
  if (std::holds_alternative<Field<int>>(key.field) ||
      std::holds_alternative<Field<std::uint64_t>>(key.field))
    json["type"] = "integer";
  json["description"] =
      std::string(key.sentence) + (key.unit.empty() ? "" : " Unit as of: " + std::string(key.unit) + ".");
  // these TOML values are JSON too
  if (key.path != "release.initial_grains") json["default"] = Json::parse(toml_of(key, Setup{}));
  return json;
}

Json schema_of(const Parameter& parameter) {
  const Json one = quantity_schema(parameter.unit, parameter.low, parameter.high, false);
  Json json;
  switch (parameter.kind) {
    case ParameterKind::number: json = one; break;
    case ParameterKind::vector:
      json = {{"oneOf", Json::array({{{"type", "array"}, {"items", one}, {"minItems", 3}, {"maxItems", 3}},
                                     {{"type", "object"},
                                      {"properties", {{"x", one}, {"y", one}, {"z", one}}},
                                      {"additionalProperties", false}}})}};
      break;
    case ParameterKind::choice: json = {{"enum", parameter.choices}}; break;
    case ParameterKind::text: json = {{"type", "string"}}; break;
    case ParameterKind::constants:
      json = {{"type", "object"}, {"additionalProperties", {{"type", Json::array({"string", "number"})}}}};
      break;
  }
  json["description"] = parameter.sentence;
  return json;
}

Json schema_of(const EffectRecord& effect) {
  Json properties{{"name", {{"const", effect.name}}}}, required = Json::array({"name"});
  for (const Parameter& parameter : effect.parameters) {
    properties[std::string(parameter.name)] = schema_of(parameter);
    if (parameter.required) required.push_back(parameter.name);
  }
  return {{"type", "object"},
          {"description", effect.sentence},
          {"properties", properties},
          {"required", required},
          {"additionalProperties", false}};
}

}  // namespace

std::string effects_json(KnownEffects effects) {
  Json json = Json::array();
  for (const EffectRecord* effect : effects) json.push_back(json_of(*effect));
  return json.dump(2) + "\n";
}

std::string setup_schema(KnownEffects effects) {
  Json properties = Json::object(), variants = Json::array();
  for (const SetupKey& key : setup_keys()) {
    Json& section = properties[std::string(key.section())];
    if (section.is_null())
      section = {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
    section["properties"][std::string(key.name())] = schema_of(key);
  }
  for (const EffectRecord* effect : effects) variants.push_back(schema_of(*effect));
  properties["effect"] = {{"type", "array"}, {"items", {{"oneOf", variants}}}};
  const Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                    {"title", "shakedown setup"},
                    {"type", "object"},
                    {"properties", properties},
                    {"additionalProperties", false}};
  return schema.dump(2) + "\n";
}

}  // namespace shakedown
