// SPDX-License-Identifier: MIT
// Writes the sentences of a diagnosis.
#pragma once
#include "diagnosis.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Returns the verdict with its reason. `known` gives effects their labels.
std::string sentence_of(const Diagnosis& diagnosis, KnownEffects known);

/// Returns "LABEL 1.4 ms +- 0.2 ms", with the label of the effect.
std::string words_of(const NuisanceFound& nuisance, KnownEffects known);

}  // namespace shakedown
