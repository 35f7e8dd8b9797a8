// SPDX-License-Identifier: MIT
// Makes what people and programs read about setups and effects from the records and the table of keys.
#pragma once
#include <span>
#include <string>

#include "effect.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Returns the word for it in texts and JSON: "contact", "grains", "box", "all", "camera".
std::string_view name_of(ActsOn acts_on);
/// Returns the word for it in texts and JSON: "exact", "to a stated error", "not modelled".
std::string_view name_of(Fidelity fidelity);

/// Returns the engines that the records name, in the order in which they do.
std::vector<std::string_view> engines_of(KnownEffects effects);

/// Returns a table of all effects: name, what it acts on, what each engine makes of it, sentence.
std::string list_effects(KnownEffects effects);

/// Returns everything about one effect, with an example for the setup.
std::string describe_effect(const EffectRecord& effect);

/// Returns the three lines or so that put the effect into a setup, at its typical strength.
std::string example_of(const EffectRecord& effect);

/// Returns all records as JSON text (an array of objects).
std::string effects_json(KnownEffects effects);

/// Returns the JSON Schema (draft 2020-12) of a setup file.
std::string setup_schema(KnownEffects effects);

/// Returns the setup's keys as a table in Markdown: key, unit, default, bounds, meaning.
std::string setup_keys_markdown();

}  // namespace shakedown
