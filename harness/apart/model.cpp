// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "errors.hpp"

namespace shakedown::apart {

namespace {

constexpr std::string_view by_midpoint = "force at the middle of each step, second order in it";
constexpr std::string_view implicit = "implicit in each step, second order in it";

struct Known {
  std::string_view name, parameters, how;
};

constexpr std::array<Known, 18> known{{
    {"blade_mass", "mass", "the box is heavier"},
    {"blade_viscous_damping", "damping", implicit},
    {"blade_quadratic_drag", "drag", implicit},
    {"clamp_dry_friction", "force", "an impulse of at most F times the step, which sticks exactly"},
    {"spring_cubic", "coefficient reference", by_midpoint},
    {"spring_quadratic", "coefficient reference", by_midpoint},
    {"pendulum", "length", by_midpoint},
    {"second_mode", "amplitude frequency rate phase", by_midpoint},
    {"constant_acceleration", "acceleration", by_midpoint},
    {"oscillating_acceleration", "amplitude frequency phase", by_midpoint},
    {"blade_arc", "blade_length", by_midpoint},
    {"grain_air_drag", "linear quadratic", implicit},
    {"side_wall_restitution", "restitution", "latching springs of that restitution"},
    {"velocity_dependent_restitution", "law exponent reference_speed",
     "latching springs of the restitution at first touch; viscoelastic by a Pade approximant, to 5e-3 above "
     "a restitution of 0.4"},
    {"fluctuating_restitution", "deviation",
     "latching springs of a restitution drawn at first touch by a generator of its own"},
    {"grain_friction", "grain_grain grain_wall",
     "tangential spring that reverses the slip in the contact time, slides at mu times the force of the "
     "latching spring"},
    {"grain_cohesion", "force range walls",
     "mean pull over each step, from the depth of the well at its ends"},
    {"grain_polydispersity", "relative_deviation", "contacts of their own masses and radii"},
}};

const Known* find(std::string_view name) {
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const Known& one) { return one.name == name; });
  return found == known.end() ? nullptr : &*found;
}

/// Writes one effect into the model.
void enter(const EffectChoice& choice, int index, const Setup& setup, Model& model) {
  const std::string_view name = choice.record->name;
  const auto number = [&](const char* key) { return choice.number(key); };
  const auto push = [&](BoxPush::Kind kind, double strength) -> BoxPush& {
    model.pushes.push_back({.kind = kind, .strength = strength, .effect = index});
    return model.pushes.back();
  };
  const auto side = static_cast<std::size_t>(ContactClass::side_wall);
  if (name == "blade_viscous_damping") {
    push(BoxPush::Kind::viscous, number("damping"));
  } else if (name == "blade_quadratic_drag") {
    push(BoxPush::Kind::quadratic, number("drag"));
  } else if (name == "clamp_dry_friction") {
    push(BoxPush::Kind::dry, number("force"));
  } else if (name == "spring_cubic") {
    const double length = number("reference") > 0 ? number("reference") : setup.release.displacement;
    model.cubic = number("coefficient") / (length * length);
  } else if (name == "spring_quadratic") {
    push(BoxPush::Kind::lopsided, model.stiffness * number("coefficient") / number("reference"));
  } else if (name == "pendulum") {
    push(BoxPush::Kind::pendulum, model.stiffness).length = number("length");
  } else if (name == "blade_arc") {
    model.arc_length = number("blade_length");
    model.arc_effect = index;
  } else if (name == "grain_air_drag") {
    model.air_linear = number("linear");
    model.air_quadratic = number("quadratic");
    model.air_effect = index;
  } else if (name == "side_wall_restitution") {
    model.restitution[side].value = number("restitution");
  } else if (name == "grain_friction") {
    model.friction = {number("grain_grain"), number("grain_wall"), number("grain_wall")};
  } else if (name == "grain_cohesion") {
    model.pull = number("force");
    model.pull_of_walls = number("force") * number("walls");
    model.reach = number("range");
  }
}

/// Writes an effect into the model that needs the whole mass of the box or the restitutions of all others.
void enter_last(const EffectChoice& choice, int index, Model& model) {
  const std::string_view name = choice.record->name;
  if (name == "constant_acceleration" || name == "oscillating_acceleration") {
    const bool wave = name == "oscillating_acceleration";
    const Vec3 strength = choice.vector(wave ? "amplitude" : "acceleration");
    const double frequency = wave ? choice.number("frequency") : 0, phase = wave ? choice.number("phase") : 0;
    model.fields.push_back({strength, frequency, phase, wave, index});
    model.pushes.push_back({.kind = wave ? BoxPush::Kind::wave : BoxPush::Kind::steady,
                            .strength = model.box_mass * strength.x(),
                            .frequency = frequency,
                            .phase = phase,
                            .effect = index});
  } else if (name == "second_mode") {
    model.pushes.push_back({.kind = BoxPush::Kind::wave,
                            .strength = model.box_mass * choice.number("amplitude"),
                            .frequency = choice.number("frequency"),
                            .phase = choice.number("phase"),
                            .rate = choice.number("rate"),
                            .effect = index});
  } else if (name == "velocity_dependent_restitution") {
    const bool power = choice.text("law") == "power";
    for (RestitutionLaw& law : model.restitution)
      law = {.kind = power ? RestitutionLaw::Kind::power : RestitutionLaw::Kind::viscoelastic,
             .value = law.value,
             .exponent = choice.number("exponent"),
             .reference_speed = choice.number("reference_speed")};
  } else if (name == "fluctuating_restitution") {
    for (RestitutionLaw& law : model.restitution)
      law = {.kind = RestitutionLaw::Kind::scattered,
             .value = law.value,
             .deviation = choice.number("deviation")};
  }
}

}  // namespace

std::string_view known_effect(std::string_view name) {
  const Known* found = find(name);
  return found == nullptr ? std::string_view{} : found->how;
}

std::string_view unknown_parameter(const EffectChoice& choice) {
  const Known* found = find(choice.record->name);
  if (found == nullptr) return {};
  for (const Parameter& parameter : choice.record->parameters) {
    if (found->parameters.find(parameter.name) != std::string_view::npos) continue;
    const auto given = choice.values.find(parameter.name);
    if (given != choice.values.end() && given->second != parameter.default_value) return parameter.name;
  }
  return {};
}

Model model_of(const Setup& setup, int run) {
  Model model;
  model.held = setup.domain != Domain::damper;
  model.box_mass = setup.box.mass;
  const double rate = 2 * std::numbers::pi * setup.spring.frequency;
  model.stiffness = setup.box.mass * rate * rate;
  model.half = Vec3(setup.box.length, setup.box.width[0], setup.box.width[1]) / 2;
  model.contact_time = setup.soft.contact_time;
  const double wall = setup.restitution.grain_wall;
  for (std::size_t kind = 0; kind < model.restitution.size(); ++kind)
    model.restitution[kind].value = kind == 0 ? setup.restitution.grain_grain : wall;
  model.seed = setup.run.seed * 1000003 + static_cast<std::uint64_t>(run);
  int index = 0;
  for (const EffectChoice& choice : setup.effects) {
    if (choice.record->name == "blade_mass") model.box_mass += choice.number("mass");
    enter(choice, index++, setup, model);
  }
  index = 0;
  for (const EffectChoice& choice : setup.effects) enter_last(choice, index++, model);
  return model;
}

}  // namespace shakedown::apart
