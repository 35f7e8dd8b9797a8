// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "effect.hpp"

namespace shakedown {

/// Returns the effect of this name. Throws InputError, with the name most like it, where there is none.
const EffectRecord& effect_asked(const std::string& name);

}  // namespace shakedown
