// SPDX-License-Identifier: MIT
// What people and programs read about setups and effects, made from the records and the table of keys.
#pragma once
#include <span>
#include <string>

#include "effect.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Word of it in texts and JSON: "contact", "grains", "box", "all", "camera".
std::string_view name_of(ActsOn acts_on);
/// Word of it in texts and JSON.
std::string_view name_of(Fidelity fidelity);

/// The engines that the records name, in the order in which they do.
std::vector<std::string_view> engines_of(KnownEffects effects);

/// A table of all effects: name, what it acts on, what each engine makes of it, sentence.
std::string list_effects(KnownEffects effects);

/// Everything about one effect, with an example for the setup.
std::string describe_effect(const EffectRecord& effect);

/// The three lines or so that put the effect into a setup, at its typical strength.
std::string example_of(const EffectRecord& effect);

/// All records as JSON text (an array of objects).
std::string effects_json(KnownEffects effects);

/// JSON Schema (draft 2020-12) of a setup file.
std::string setup_schema(KnownEffects effects);

/// The setup's keys as a table in Markdown: key, unit, default, bounds, meaning.
std::string setup_keys_markdown();

}  // namespace shakedown
