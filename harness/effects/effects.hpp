// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "effect.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Returns every effect that a setup may name, in the order of the documentation. A new effect is one file
/// and one line in effects.cpp.
KnownEffects all_effects();

/// Returns the effect of this name, or nullptr.
const EffectRecord* find_effect(std::string_view name);

}  // namespace shakedown
