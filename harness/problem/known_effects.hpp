// SPDX-License-Identifier: MIT
// The effects that a caller knows. Libraries below the catalogue of effects are handed them.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "effect.hpp"

namespace shakedown {

/// A view of records in the order of the documentation: `all_effects()`, or those of a caller's own. The
/// records must outlive it.
class KnownEffects : public std::span<const EffectRecord* const> {
 public:
  using std::span<const EffectRecord* const>::span;

  /// Returns the record of this name; null where there is none.
  const EffectRecord* find(std::string_view name) const;
  /// Returns the parameter at "effect.parameter" or "effect.parameter.component"; null where there is none.
  const Parameter* find_parameter(std::string_view key) const;
  /// "effect.parameter" of the effect that sets this number of the camera; empty: nobody knows one.
  std::string key_of(double Camera::*number) const;
  /// Returns the effects whose strength oscillates at a frequency that a diagnosis searches. They make the
  /// same motion, so the first of them is named.
  std::vector<const EffectRecord*> oscillating() const;
  /// Returns how many of them a diagnosis of a box with grains looks for: the prior is shared out among so
  /// many.
  std::size_t searched() const;
};

/// Returns the effect whose parameter a key names: what stands before its first dot.
inline std::string_view effect_of(std::string_view key) { return key.substr(0, key.find('.')); }

}  // namespace shakedown
