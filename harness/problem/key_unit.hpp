// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "effect.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Returns the unit in which people read the values of a key of the setup or of an effect ("box.length",
/// "constant_acceleration.acceleration.x"; of keys joined by & the first); empty: a pure number, or no such
/// key.
std::string unit_of_key(std::string_view key, KnownEffects known);

/// Returns the SI unit of such a key, in which a setup or a fit holds its values.
std::string si_unit_of_key(std::string_view key, KnownEffects known);

/// Returns the keys that "grain_friction.grain_grain&grain_friction.grain_wall" joins to move together; of
/// one key itself.
std::vector<std::string> joined_keys(std::string_view keys);

}  // namespace shakedown
