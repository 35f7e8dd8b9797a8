// SPDX-License-Identifier: MIT
#include "effects.hpp"

#include <vector>

namespace shakedown {

std::span<const EffectRecord* const> all_effects() {
  static const std::vector<const EffectRecord*> effects{};
  return effects;
}

const EffectRecord* find_effect(std::string_view name) {
  for (const EffectRecord* effect : all_effects())
    if (effect->name == name) return effect;
  return nullptr;
}

}  // namespace shakedown
