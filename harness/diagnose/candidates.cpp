// SPDX-License-Identifier: MIT
#include "candidates.hpp"

#include <algorithm>
#include <map>

#include "known_effects.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// A knob of an effect's parameter, from its record: bounds, and one typical strength about its neutral
/// value.
Knob knob_of(const EffectRecord& effect, const Parameter& parameter, std::string_view component = "") {
  const std::string key =
      std::string(effect.name) + "." + std::string(parameter.name) + std::string(component);
  return {key, 0.0, parameter.typical, parameter.low, parameter.high, true};
}

std::vector<Candidate> all_candidates(const Setup& setup, std::span<const EffectRecord* const> known) {
  std::vector<Candidate> list;
  const auto add = [&](std::string_view name, std::string_view parameter, bool momentum,
                       std::string_view component = "") {
    if (const EffectRecord* effect = find_record(known, name))
      list.push_back(
          {std::string(name), {knob_of(*effect, *effect->find(parameter), component)}, {}, momentum});
  };
  // The first tenth of friction does as much as the next two, and more than .25 dissipates less again (fitted
  // restitutions of frictional runs): no parabola.
  Knob friction{"grain_friction.grain_grain&grain_friction.grain_wall", 0, 0.2, 0, 1, true};
  friction.cubic = true;
  list.push_back({"grain_friction", {friction}, {}, false, 0, true, true});
  add("velocity_dependent_restitution", "exponent", false);
  list.back().always = true;
  // What matters to moving grains is force times range. Ranges beyond the gaps of the packing let the hard
  // engine's wells hold the layer at the wall for good, and so do stronger forces.
  list.push_back({"grain_cohesion",
                  {{"grain_cohesion.force", 0, 8e-3, 0, 2e-2, true}},
                  {{"grain_cohesion.range", 2e-5}},
                  false,
                  4,
                  true});
  list.push_back(
      {"side_wall_restitution",
       {{"side_wall_restitution.restitution", setup.restitution.grain_wall, 0.2, 0.05, 0.999, true}},
       {},
       false});
  add("grain_polydispersity", "relative_deviation", false);
  add("grain_air_drag", "linear", false);
  list.back().slow = true;
  list.back().doubt = 10;  // air of 1 bar drags a grain some hundred times less than such data can show
  for (const char* axis : {".y", ".z"}) {
    // Across the axis both signs do the same: nothing is linear about zero, so it is looked for about a
    // strength.
    add("constant_acceleration", "acceleration", false, axis);
    list.back().slow = true;
    Knob& knob = list.back().knobs[0];
    knob.centre = knob.width = 0.15;
    knob.low = 0;
  }
  list.push_back({"blade_arc", {}, {{"blade_arc.blade_length", 0.59}}, false});
  list.back().when_tried = {{"blade_arc.blade_length", 0.7, 0.3, 0.2, 3, true}};
  add("camera_com_bias", "bias", true);
  list.push_back({"camera_arc", {}, {{"camera_arc.blade_length", 0.59}}, true});
  add("camera_scale", "scale", false);
  add("camera_time_offset", "offset", false);
  add("camera_drift", "drift", true);
  add("initial_box_velocity", "velocity", false);
  add("blade_viscous_damping", "damping", true);
  add("blade_quadratic_drag", "drag", true);
  add("clamp_dry_friction", "force", true);
  add("spring_cubic", "coefficient", true);
  add("constant_acceleration", "acceleration", true, ".x");
  list.back().knobs[0].width = 0.1;
  return list;
}

}  // namespace

std::vector<Candidate> candidates_for(const Setup& setup, const std::vector<std::string>& only,
                                      std::span<const EffectRecord* const> known) {
  std::vector<Candidate> list = all_candidates(setup, known);
  std::erase_if(list, [&](const Candidate& candidate) {
    if (!only.empty() && std::find(only.begin(), only.end(), candidate.effect) == only.end()) return true;
    return find_choice(setup, candidate.effect) != nullptr;
  });
  return list;
}

ScatterGroups scatter_groups(const std::vector<Candidate>& candidates) {
  ScatterGroups groups;
  std::map<std::string, std::vector<std::size_t>> slow;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (candidates[c].knobs.empty()) continue;
    if (candidates[c].dear)
      groups.dear.push_back({c});
    else
      (candidates[c].slow ? slow[candidates[c].effect] : groups.cheap).push_back(c);
  }
  for (auto& [effect, members] : slow) groups.slow.push_back(std::move(members));
  return groups;
}

Setup prepared(const Setup& setup, const Candidate& candidate, std::span<const EffectRecord* const> known) {
  Setup changed = setup;
  for (const auto& [key, value] : candidate.fixed) set_number(changed, key, value, known);
  return changed;
}

}  // namespace shakedown
