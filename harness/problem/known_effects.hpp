// SPDX-License-Identifier: MIT
// Effects by name: records among those that a caller knows (libraries below the catalogue of effects are
// handed them), and what a setup has chosen of them.
#pragma once
#include <algorithm>
#include <span>
#include <string_view>

#include "effect.hpp"
#include "setup.hpp"

namespace shakedown {

/// The record of this name; null: nobody knows it.
inline const EffectRecord* find_record(std::span<const EffectRecord* const> known, std::string_view name) {
  for (const EffectRecord* record : known)
    if (record->name == name) return record;
  return nullptr;
}

/// How many of them a diagnosis of a box with grains looks for: among so many the prior of one is shared out.
inline std::size_t searched_effects(std::span<const EffectRecord* const> known) {
  return static_cast<std::size_t>(std::count_if(known.begin(), known.end(), [](const EffectRecord* record) {
    return !record->nuisance && record->search.not_searched.empty();
  }));
}

/// The setup's choice of this effect; null: it has none. It lives as long as the setup's list is not changed.
inline const EffectChoice* find_choice(const Setup& setup, std::string_view name) {
  for (const EffectChoice& choice : setup.effects)
    if (choice.record->name == name) return &choice;
  return nullptr;
}

/// The effect whose parameter a key names: what stands before its first dot.
inline std::string_view effect_of(std::string_view key) { return key.substr(0, key.find('.')); }

/// The parameter at "effect.parameter" or "effect.parameter.component"; null: there is none.
inline const Parameter* find_parameter(std::span<const EffectRecord* const> known, std::string_view key) {
  const std::size_t dot = key.find('.');
  const EffectRecord* record = dot == key.npos ? nullptr : find_record(known, key.substr(0, dot));
  if (record == nullptr) return nullptr;
  const std::string_view rest = key.substr(dot + 1);
  return record->find(rest.substr(0, rest.find('.')));
}

}  // namespace shakedown
