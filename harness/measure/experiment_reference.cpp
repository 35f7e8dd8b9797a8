// SPDX-License-Identifier: MIT
#include "experiment_reference.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiment_keys.hpp"
#include "known_value.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
using Kind = ExperimentKind;
using Where = ExperimentTable;

constexpr std::string_view known_pattern =
    "^\\(?\\s*[-+]?[0-9.]+([eE][-+]?[0-9]+)?\\s*[^\\s]*\\s*(\\+-|\\+/-|\u00b1)\\s*[0-9.]+.*$";

constexpr std::string_view conventions = R"(
Conventions:

* x is counted along the motion, from where the spring is relaxed (the box at rest, nothing else pulling), and grows
  towards the side of the release: `release.displacement` is positive as a rule. `origin` and `reversed` make it so.
* The box's position is that of its centre; any point fixed to it will do, with `origin` what that point reads at rest.
* The grains' centre is the mean of their centres, in the frame of the laboratory, from the same zero as the box.
* Time is counted from the release. Frames that were lost are absent or blank, never repeated. What lies before
  `release_time` is no part of the motion.
* Quantities are texts with a unit ("107.5 mm"); a bare number where a unit is due is an error.
* An error is one standard deviation. `+-` may be written as `±`; the unit once or with both.
)";

const std::vector<ExperimentTable> tables{Where::file, Where::camera, Where::column, Where::run};

std::string bounds_of(const ExperimentKey& key) {
  if (key.kind == Kind::choice) {
    std::string words;
    for (const std::string_view word : key.choices) (words += words.empty() ? "" : ", ") += word;
    return words;
  }
  if (key.kind == Kind::flag) return "true, false";
  if (key.kind != Kind::quantity) return "";
  std::string bounds;
  if (std::isfinite(key.low)) bounds = "> " + write_quantity(key.low, key.unit);
  if (std::isfinite(key.high))
    bounds += (bounds.empty() ? "<= " : ", <= ") + write_quantity(key.high, key.unit);
  return bounds;
}

std::string row(const std::string& key, const std::string& example, const std::string& bounds,
                std::string_view meaning) {
  return "| `" + key + "` | `" + example + "` | " + bounds + " | " + std::string(meaning) + " |\n";
}

Json schema_of(const ExperimentKey& key, const Json& column, const Json& known) {
  Json json;
  switch (key.kind) {
    case Kind::text:
    case Kind::quantity:
    case Kind::position: json = {{"type", "string"}}; break;
    case Kind::texts:
      json = {{"oneOf", Json::array({{{"type", Json::array({"string", "integer"})}},
                                     {{"type", "array"},
                                      {"items", {{"type", Json::array({"string", "integer"})}}}}})}};
      break;
    case Kind::flag: json = {{"type", "boolean"}}; break;
    case Kind::choice:
      json = {{"oneOf", Json::array({{{"enum", key.choices}}, {{"type", "object"}}})}};
      break;
    case Kind::table: json = key.name == "column" ? column : key.name == "known" ? known : Json{}; break;
    case Kind::tables: break;  // put together below
  }
  json["description"] = key.sentence;
  if (key.kind == Kind::quantity || key.kind == Kind::position)
    json["examples"] = Json::array({Json::parse(key.example)});
  return json;
}

Json properties_of(Where table, const Json& column, const Json& known) {
  Json properties = Json::object();
  for (const ExperimentKey& key : experiment_keys())
    if (key.table == table) properties[std::string(key.name)] = schema_of(key, column, known);
  return properties;
}

Json object_of(const Json& properties, bool closed = true) {
  Json json{{"type", "object"}, {"properties", properties}};
  if (closed) json["additionalProperties"] = false;
  return json;
}

/// [known]: in quotes, or below tables of the setup's sections.
Json schema_of_known() {
  const Json value{{"type", "string"}, {"pattern", known_pattern}};
  Json properties = Json::object();
  for (const SetupKey* key : knowable_setup_keys()) {
    properties[std::string(key->path)] = value;
    properties[std::string(key->path)]["description"] = key->sentence;
    properties[std::string(key->section())] = {{"type", "object"}};
  }
  for (const CameraKey& key : camera_keys()) {
    properties[std::string(key.path)] = value;
    properties[std::string(key.path)]["description"] = key.sentence;
  }
  properties["camera"] = {{"type", "object"}};
  return object_of(properties);
}

}  // namespace

std::string experiment_schema() {
  const Json known = schema_of_known(), one = object_of(properties_of(Where::column, {}, {}));
  const Json column = object_of({{"time", one},
                                 {"box_position", one},
                                 {"box_velocity", one},
                                 {"box_acceleration", one},
                                 {"grain_centre", one},
                                 {"base_position", one}});
  Json properties = properties_of(Where::file, column, known);
  properties["camera"] = object_of(properties_of(Where::camera, {}, {}));
  // Beside its own keys a run has tables: keys of the setup, effects among them.
  Json run = object_of(properties_of(Where::run, column, known), false);
  run["additionalProperties"] = {{"type", "object"}};
  run["required"] = Json::array({"file"});
  properties["run"] = {{"type", "array"}, {"minItems", 1}, {"items", run}};
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "shakedown experiment"}};
  schema.update(object_of(properties));
  schema["required"] = Json::array({"run"});
  return schema.dump(2) + "\n";
}

std::string experiment_keys_markdown() {
  std::string text;
  for (const Where table : tables) {
    const std::string_view name = written_name(table);
    text += (text.empty() ? "" : "\n") +
            (name.empty() ? std::string("Of the file:\n") : "`" + std::string(name) + "`:\n") +
            "\n| key | example | bounds | meaning |\n|---|---|---|---|\n";
    for (const ExperimentKey& key : experiment_keys())
      if (key.table == table)
        text += row(std::string(key.name), std::string(key.example), bounds_of(key), key.sentence);
  }
  text +=
      "\nA run may set any key of the setup for itself, with a dot: `grains.count = 0`, "
      "`release.displacement = "
      "\"90 mm\"`.\n\n`[known]`: value and error of box.mass, grains.mass, spring.frequency, "
      "restitution.grain_grain, restitution.grain_wall, release.displacement (in quotes: `\"box.mass\" = "
      "\"434 g +- "
      "2 g\"`; `release.displacement` of each run independently). The value goes before the setup's, the "
      "error counts "
      "in every interval, `+- 0` fixes; other numbers of the setup's sections box, spring, blade, grains, "
      "release may "
      "be said with `+- 0` alone. Numbers of effects inside the contacts or on the grains, as a test of the "
      "grains alone tells them, likewise: `\"velocity_dependent_restitution.exponent\" = \"0.08 +- 0.01\"` "
      "(a "
      "drop test, `shakedown bounce`), `\"grain_friction.grain_wall\" = \"0.2 +- 0.03\"` (a grain that "
      "slides on "
      "a tilted plate slips at the angle whose tangent mu is). The effect is then part of the model as "
      "given, "
      "and its number free within the error. And of camera and clock (0: nothing wrong expected; else the "
      "value is put "
      "into "
      "the model)\n\n| key | example | bounds | meaning |\n|---|---|---|---|\n";
  for (const CameraKey& key : camera_keys())
    text += row(std::string(key.path), example_of(key), key.positive ? ">= 0" : "",
                std::string(key.sentence) + (key.each_run ? " Of each run independently." : ""));
  return text + std::string(conventions);
}

}  // namespace shakedown
