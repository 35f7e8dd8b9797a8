// SPDX-License-Identifier: MIT
// The effects that a caller knows. Libraries below the catalogue of effects are handed them.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "effect.hpp"

namespace shakedown {

/// A view of records in the order of the documentation: `all_effects()`, or those of a caller's own. The
/// records must outlive it.
class KnownEffects : public std::span<const EffectRecord* const> {
 public:
  using std::span<const EffectRecord* const>::span;

  /// The record of this name; null: nobody knows it.
  const EffectRecord* find(std::string_view name) const;
  /// The parameter at "effect.parameter" or "effect.parameter.component"; null: there is none.
  const Parameter* find_parameter(std::string_view key) const;
  /// Effects whose strength oscillates at a frequency that a diagnosis searches. They make the same motion:
  /// the first is named.
  std::vector<const EffectRecord*> oscillating() const;
  /// How many of them a diagnosis of a box with grains looks for: among so many the prior of one is shared
  /// out.
  std::size_t searched() const;
};

/// The effect whose parameter a key names: what stands before its first dot.
inline std::string_view effect_of(std::string_view key) { return key.substr(0, key.find('.')); }

}  // namespace shakedown
