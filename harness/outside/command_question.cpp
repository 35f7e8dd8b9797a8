// SPDX-License-Identifier: MIT
#include "command_question.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Vec3& value) { return {value.x(), value.y(), value.z()}; }

Json json_of(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* vector = std::get_if<Vec3>(&value)) return json_of(*vector);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return std::get<std::map<std::string, double>>(value);
}

Json effects_of(const Setup& setup) {
  Json effects = Json::array();
  for (const EffectChoice& choice : setup.effects) {
    if (choice.record->capability(every_engine).fidelity != Fidelity::not_modelled) continue;
    Json parameters = Json::object();
    for (const auto& [name, value] : choice.values) parameters[name] = json_of(value);
    effects.push_back({{"name", choice.record->name}, {"parameters", parameters}});
  }
  return effects;
}

Json grains_of(const State& initial) {
  Json grains = Json::array();
  for (std::size_t i = 0; i < initial.size(); ++i)
    grains.push_back({{"radius", initial.radius[i]},
                      {"mass", initial.mass[i]},
                      {"position", json_of(initial.position[i])},
                      {"velocity", json_of(initial.velocity[i])}});
  return grains;
}

}  // namespace

std::size_t command_rows(const Setup& setup) {
  return static_cast<std::size_t>(std::floor(setup.run.duration * setup.run.sample_rate * (1 + 1e-12))) + 1;
}

std::string command_question(const Setup& setup, const Physics& physics, const State& initial, int run) {
  const Json question = {
      {"format", command_format},
      {"domain", setup.domain == Domain::damper ? "damper" : "closed"},
      {"seed", setup.run.seed},
      {"run", run},
      {"rows", command_rows(setup)},
      {"sample_rate", setup.run.sample_rate},
      {"box",
       {{"mass", physics.box_mass},
        {"length", setup.box.length},
        {"width", setup.box.width},
        {"position", initial.x_box},
        {"velocity", initial.v_box}}},
      {"spring", {{"stiffness", physics.stiffness}}},
      {"restitution",
       {{"grain_grain", setup.restitution.grain_grain}, {"grain_wall", setup.restitution.grain_wall}}},
      {"contact_time", setup.soft.contact_time},
      {"steps_per_contact", setup.soft.steps_per_contact},
      {"effects", effects_of(setup)},
      {"grains", grains_of(initial)}};
  return question.dump(1) + "\n";
}

}  // namespace shakedown
