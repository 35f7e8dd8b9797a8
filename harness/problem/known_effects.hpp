// SPDX-License-Identifier: MIT
// Records among those that a caller knows: libraries below the catalogue of effects are handed them.
#pragma once
#include <span>
#include <string_view>

#include "effect.hpp"

namespace shakedown {

/// The record of this name; null: nobody knows it.
inline const EffectRecord* find_record(std::span<const EffectRecord* const> known, std::string_view name) {
  for (const EffectRecord* record : known)
    if (record->name == name) return record;
  return nullptr;
}

/// The parameter at "effect.parameter" or "effect.parameter.component"; null: there is none.
inline const Parameter* find_parameter(std::span<const EffectRecord* const> known, std::string_view key) {
  const std::size_t dot = key.find('.');
  const EffectRecord* record = dot == key.npos ? nullptr : find_record(known, key.substr(0, dot));
  if (record == nullptr) return nullptr;
  const std::string_view rest = key.substr(dot + 1);
  return record->find(rest.substr(0, rest.find('.')));
}

}  // namespace shakedown
