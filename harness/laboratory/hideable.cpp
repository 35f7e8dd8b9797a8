// SPDX-License-Identifier: MIT
#include "hideable.hpp"

#include "key_unit.hpp"
#include "quantity.hpp"
#include "setup_keys.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

using As = Hideable::As;

/// Values for one knob of each, near those of the open cases.
const std::vector<Hideable> effects{
    {.id = "grain_friction",
     .effect = "grain_friction",
     .family = "contact",
     .key = "grain_friction.grain_grain&grain_friction.grain_wall",
     .typical = 0.2,
     .strongest = 5},
    {.id = "velocity_dependent_restitution",
     .effect = "velocity_dependent_restitution",
     .family = "contact",
     .key = "velocity_dependent_restitution.exponent",
     .typical = 0.1,
     .strongest = 5},
    {.id = "grain_cohesion",
     .effect = "grain_cohesion",
     .family = "contact",
     .key = "grain_cohesion.force",
     .typical = 0.02,
     .unit = "N",
     .strongest = 10},
    {.id = "side_wall_restitution",
     .effect = "side_wall_restitution",
     .family = "contact",
     .key = "side_wall_restitution.restitution",
     .typical = 0.2,
     .as = As::away,
     .away_from = 0.76,
     .strongest = 3.3},
    {.id = "grain_polydispersity",
     .effect = "grain_polydispersity",
     .family = "grain_polydispersity",
     .key = "grain_polydispersity.relative_deviation",
     .typical = 0.05,
     .strongest = 2},
    {.id = "grain_air_drag",
     .effect = "grain_air_drag",
     .family = "drag",
     .key = "grain_air_drag.linear",
     .typical = 0.001,
     .unit = "N s/m",
     .strongest = 20},
    {.id = "constant_acceleration.x",
     .effect = "constant_acceleration",
     .family = "constant_acceleration",
     .key = "constant_acceleration.acceleration.x",
     .typical = 0.1,
     .unit = "m/s^2",
     .strongest = 5},
    {.id = "constant_acceleration.z",
     .effect = "constant_acceleration",
     .family = "constant_acceleration",
     .key = "constant_acceleration.acceleration.z",
     .typical = 0.1,
     .unit = "m/s^2",
     .strongest = 20},
    {.id = "oscillating_acceleration",
     .effect = "oscillating_acceleration",
     .family = "oscillating_acceleration",
     .key = "oscillating_acceleration.amplitude.x",
     .typical = 0.1,
     .unit = "m/s^2",
     .strongest = 10},
    {.id = "initial_box_velocity",
     .effect = "initial_box_velocity",
     .family = "release",
     .key = "initial_box_velocity.velocity",
     .typical = 0.02,
     .unit = "m/s",
     .strongest = 10},
    {.id = "blade_viscous_damping",
     .effect = "blade_viscous_damping",
     .family = "drag",
     .key = "blade_viscous_damping.damping",
     .typical = 0.05,
     .unit = "N s/m",
     .strongest = 10},
    {.id = "blade_quadratic_drag",
     .effect = "blade_quadratic_drag",
     .family = "drag",
     .key = "blade_quadratic_drag.drag",
     .typical = 0.03,
     .unit = "N s^2/m^2",
     .strongest = 20},
    {.id = "clamp_dry_friction",
     .effect = "clamp_dry_friction",
     .family = "drag",
     .key = "clamp_dry_friction.force",
     .typical = 0.02,
     .unit = "N",
     .strongest = 10},
    {.id = "spring_cubic",
     .effect = "spring_cubic",
     .family = "spring",
     .key = "spring_cubic.coefficient",
     .typical = 0.04,
     .strongest = 20},
    {.id = "blade_arc",
     .effect = "blade_arc",
     .family = "spring",
     .key = "blade_arc.blade_length",
     .typical = 0.59,
     .unit = "m",
     .as = As::inverse,
     .strongest = 4},
    {.id = "camera_com_bias",
     .effect = "camera_com_bias",
     .family = "camera of the centre",
     .key = "camera_com_bias.bias",
     .typical = 0.05,
     .strongest = 10,
     .camera = true},
    {.id = "camera_arc",
     .effect = "camera_arc",
     .family = "camera of the centre",
     .key = "camera_arc.blade_length",
     .typical = 0.59,
     .unit = "m",
     .as = As::inverse,
     .strongest = 5,
     .camera = true},
    {.id = "camera_scale",
     .effect = "camera_scale",
     .family = "camera_scale",
     .key = "camera_scale.scale",
     .typical = 0.01,
     .strongest = 20,
     .camera = true},
    {.id = "camera_time_offset",
     .effect = "camera_time_offset",
     .family = "release",
     .key = "camera_time_offset.offset",
     .typical = 0.002,
     .unit = "s",
     .strongest = 20,
     .camera = true},
    {.id = "camera_drift",
     .effect = "camera_drift",
     .family = "camera_drift",
     .key = "camera_drift.drift",
     .typical = 1e-4,
     .unit = "m/s",
     .strongest = 50,
     .camera = true},
};

const std::vector<Hideable> forces{
    {.id = "force:eddy brake",
     .effect = "user_force",
     .family = "unknown",
     .typical = 0.2,
     .unit = "N s/m",
     .strongest = 50,
     .formula = "-c*v*exp(-((x-x0)/w)^2)",
     .constants = "x0 = \"45 mm\", w = \"12 mm\""},
    {.id = "force:thickening",
     .effect = "user_force",
     .family = "unknown",
     .typical = 10,
     .unit = "N s/m^3",
     .strongest = 50,
     .formula = "-c*v*x^2"},
    {.id = "force:cubic drag",
     .effect = "user_force",
     .family = "unknown",
     .typical = 0.1,
     .unit = "N s^3/m^3",
     .strongest = 50,
     .formula = "-c*v^3"},
    {.id = "force:lopsided spring",
     .effect = "user_force",
     .family = "unknown",
     .typical = 5,
     .unit = "N/m^2",
     .strongest = 50,
     .formula = "-c*x^2"},
    {.id = "force:soft stop",
     .effect = "user_force",
     .family = "unknown",
     .typical = 5,
     .unit = "N/m",
     .strongest = 50,
     .formula = "-c*max(x-x0,0)",
     .constants = "x0 = \"60 mm\""},
    {.id = "force:fading push",
     .effect = "user_force",
     .family = "unknown",
     .typical = 0.1,
     .unit = "N",
     .strongest = 50,
     .formula = "c*exp(-t/tau)",
     .constants = "tau = \"2 s\""},
};

double value_at(const Hideable& hideable, double strength) {
  switch (hideable.as) {
    case As::proportional: return hideable.typical * strength;
    case As::inverse: return hideable.typical / strength;
    case As::away: return hideable.away_from - hideable.typical * strength;
  }
  return 0;
}

}  // namespace

const std::vector<Hideable>& hideable_effects() { return effects; }
const std::vector<Hideable>& hideable_forces() { return forces; }

const Hideable* find_hideable(std::string_view id) {
  for (const std::vector<Hideable>* list : {&effects, &forces})
    for (const Hideable& hideable : *list)
      if (hideable.id == id) return &hideable;
  return nullptr;
}

std::string_view family_of(std::string_view effect) {
  if (effect == "blade_mass") return "camera of the centre";  // the same thing to the momentum balance
  for (const Hideable& hideable : effects)
    if (hideable.effect == effect) return hideable.family;
  return effect;
}

std::vector<Override> at_strength(const Hideable& hideable, double strength, double frequency, double phase) {
  const std::string origin = "blind suite";
  const std::string value = toml_of(value_at(hideable, strength), hideable.unit);
  if (!hideable.formula.empty()) {
    const std::string more = hideable.constants.empty() ? "" : ", " + std::string(hideable.constants);
    return {{"user_force.force", toml_string(hideable.formula), origin},
            {"user_force.constants", "{c = " + value + more + "}", origin}};
  }
  std::vector<Override> overrides;
  for (const std::string& key : joined_keys(hideable.key)) overrides.push_back({key, value, origin});
  if (hideable.effect == "oscillating_acceleration") {
    overrides.push_back({"oscillating_acceleration.frequency", toml_of(frequency, "Hz"), origin});
    overrides.push_back({"oscillating_acceleration.phase", toml_of(phase, "rad"), origin});
  }
  return overrides;
}

Setup changed(const Setup& setup, const std::vector<Override>& overrides,
              std::span<const EffectRecord* const> known) {
  return parse_setup(write_setup(setup), "setup", known, overrides);
}

}  // namespace shakedown
