// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Returns "restitution.grain_grain,spring.frequency" as knobs that start at the setup's values; keys joined
/// by & move together. Values stay within the bounds of the key and a factor of three of the start (the
/// spring's frequency two, numbers of an effect twenty widths from it, restitutions below 0.995). Throws
/// InputError with every violation.
std::vector<Knob> free_parameters(std::string_view text, const Setup& setup, KnownEffects known);

}  // namespace shakedown
