// SPDX-License-Identifier: MIT
// How strong an effect is, as one number: what a diagnosis searches and a laboratory hides, from the record.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "effect.hpp"
#include "setup.hpp"

namespace shakedown {

/// Returns how a diagnosis looks for the effect, every field filled in. A record without strengths of its own
/// is searched by its first number with a typical value and a neutral one (of a vector each component), at
/// half, once and twice the typical strength within its bounds, from its low to its high bound.
Search search_of(const EffectRecord& record);

/// Returns the strength's keys in a setup: "grain_friction.grain_grain&grain_friction.grain_wall".
std::string keys_of(const EffectRecord& record, const SearchedStrength& strength);

/// Returns the parameter that holds the strength (of several the first).
const Parameter& parameter_of(const EffectRecord& record, const SearchedStrength& strength);

/// Returns the value at which the effect is absent from this setup, SI; infinite where it is `inverse`.
double absent_value(const EffectRecord& record, const SearchedStrength& strength, const Setup& setup);

/// Returns the value of the parameters at a level, SI, given the one when absent. A change that leaves the
/// bounds by more than a fifth of it is made the other way.
double value_at_level(const SearchedStrength& strength, double level, double absent);

/// Returns the strength as people read it: "linear damping of the box, 0.05 N s/m".
std::string strength_in_words(const EffectRecord& record, const SearchedStrength& strength, double value);

/// Returns the name that effects have in common which look alike in most experiments: the record's family, or
/// else its own name.
std::string_view family_of(const EffectRecord& record);

}  // namespace shakedown
