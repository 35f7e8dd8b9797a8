// SPDX-License-Identifier: MIT
#include "parameter_knobs.hpp"

namespace shakedown {

std::vector<Knob> as_given(const Setup& setup) {
  const auto knob = [](const char* key, double value, double apart) {
    return Knob{key, value, 2.5 * apart, value - 2.5 * apart, value + 2.5 * apart, false, value, apart};
  };
  return {knob("restitution.grain_grain", setup.restitution.grain_grain, code_restitution),
          knob("restitution.grain_wall", setup.restitution.grain_wall, code_restitution),
          knob("spring.frequency", setup.spring.frequency, code_frequency * setup.spring.frequency)};
}

std::vector<Knob> free_parameters(const Setup& setup, double frequency, double width) {
  const auto restitution = [](const char* key, double value) {
    return Knob{key, value, 0.15, 0.3, 0.999, true, value, believed_restitution};
  };
  return {restitution("restitution.grain_grain", setup.restitution.grain_grain),
          restitution("restitution.grain_wall", setup.restitution.grain_wall),
          {"spring.frequency", frequency, width, 0.5 * frequency, 2 * frequency, true}};
}

std::vector<Knob> free_parameters(const Setup& setup) {
  return free_parameters(setup, setup.spring.frequency, 0.01 * setup.spring.frequency);
}

}  // namespace shakedown
