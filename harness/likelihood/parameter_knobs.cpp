// SPDX-License-Identifier: MIT
#include "parameter_knobs.hpp"

#include <algorithm>
#include <cmath>

namespace shakedown {

Knob exact_knob(const std::string& key, double value, double deviation) {
  constexpr double far = 6;  // standard deviations: a bound that no camera and no balance meets
  Knob knob{key, value, deviation, value - far * deviation, value + far * deviation, false, value, deviation};
  knob.exact = true;
  return knob;
}

namespace {

constexpr double reach_as_given = 2.5;  // standard deviations
constexpr double reach_of_a_fit = 1.5;  // of what is believed, as that of the restitutions

/// Returns one knob for each number of an effect that is known to an error, so many errors wide.
std::vector<Knob> of_effects(const std::vector<KnownValue>& known, KnownEffects effects, double errors,
                             bool curved) {
  std::vector<Knob> knobs;
  for (const KnownValue& said : known) {
    const Parameter* parameter = find_component_number(effects, said.key);
    if (parameter == nullptr || said.error == 0) continue;
    Knob knob{said.key,        said.value, errors * said.error, parameter->low,
              parameter->high, curved,     said.value,          said.error};
    knobs.push_back(knob);
  }
  return knobs;
}

}  // namespace

std::vector<Knob> as_given(const Setup& setup, const std::vector<KnownValue>& known, KnownEffects effects) {
  const auto knob = [&](const char* key, double value, double apart, double highest) {
    if (const KnownValue* said = find_known(known, key)) apart = std::hypot(apart, said->error);
    const double reach = reach_as_given * apart;
    return Knob{key,   value, reach, std::max(0.0, value - reach), std::min(highest, value + reach),
                false, value, apart};
  };
  const double frequency = setup.spring.frequency;
  const Knob of_spring = knob("spring.frequency", frequency, code_frequency * frequency, 2 * frequency);
  if (setup.grains.count == 0) return {of_spring};  // nothing hits anything
  std::vector<Knob> knobs{knob("restitution.grain_grain", setup.restitution.grain_grain, code_restitution, 1),
                          knob("restitution.grain_wall", setup.restitution.grain_wall, code_restitution, 1),
                          of_spring};
  for (Knob& of_effect : of_effects(known, effects, reach_as_given, false)) {
    of_effect.low = std::max(of_effect.low, of_effect.centre - of_effect.width);
    of_effect.high = std::min(of_effect.high, of_effect.centre + of_effect.width);
    knobs.push_back(std::move(of_effect));
  }
  return knobs;
}

std::vector<Knob> free_parameters(const Setup& setup, double frequency, double width) {
  const auto restitution = [](const char* key, double value) {
    const double low = std::min(0.3, std::max(0.01, value - 0.2));
    return Knob{key, value, 0.15, low, std::max(0.999, value), true, value, believed_restitution};
  };
  const Knob of_spring{"spring.frequency", frequency, width, 0.5 * frequency, 2 * frequency, true};
  if (setup.grains.count == 0) return {of_spring};
  return {restitution("restitution.grain_grain", setup.restitution.grain_grain),
          restitution("restitution.grain_wall", setup.restitution.grain_wall), of_spring};
}

std::vector<Knob> free_parameters(const Setup& setup) {
  return free_parameters(setup, setup.spring.frequency, 0.01 * setup.spring.frequency);
}

std::vector<Knob> believed(std::vector<Knob> knobs, const std::vector<KnownValue>& known,
                           KnownEffects effects) {
  std::erase_if(knobs, [&](const Knob& knob) {
    const KnownValue* said = find_known(known, knob.key);
    return said != nullptr && said->error == 0;
  });
  for (Knob& knob : knobs)
    if (const KnownValue* said = find_known(known, knob.key)) {
      knob.believed = said->value, knob.believed_error = said->error;
      knob.low = std::min(knob.low, said->value), knob.high = std::max(knob.high, said->value);
    }
  for (Knob& of_effect : of_effects(known, effects, reach_of_a_fit, true))
    knobs.push_back(std::move(of_effect));
  return knobs;
}

}  // namespace shakedown
