// SPDX-License-Identifier: MIT
#include "effect_asked.hpp"

#include "effects.hpp"
#include "suggestion.hpp"

namespace shakedown {

const EffectRecord& effect_asked(const std::string& name) {
  if (const EffectRecord* effect = find_effect(name)) return *effect;
  std::vector<std::string_view> names;
  for (const EffectRecord* effect : all_effects()) names.push_back(effect->name);
  throw InputError({{{},
                     "effects",
                     "there is no effect '" + name + "'",
                     did_you_mean(name, names) + "`shakedown effects` lists them all"}});
}

}  // namespace shakedown
