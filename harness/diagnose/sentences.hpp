// SPDX-License-Identifier: MIT
// The sentences of a diagnosis.
#pragma once
#include "diagnosis.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// The verdict with its reason. `known` gives effects their labels.
std::string sentence_of(const Diagnosis& diagnosis, KnownEffects known);

/// "camera_shutter.time 1.4 ms (+- 0.2)".
std::string words_of(const NuisanceFound& nuisance, KnownEffects known);

}  // namespace shakedown
