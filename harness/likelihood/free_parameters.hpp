// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// "restitution.grain_grain,spring.frequency" as knobs that start at the setup's values; keys joined by &
/// move together. Bounds are those of the key, within a factor of three of the start for quantities that have
/// none. Throws InputError with every violation.
std::vector<Knob> free_parameters(std::string_view text, const Setup& setup, KnownEffects known);

}  // namespace shakedown
