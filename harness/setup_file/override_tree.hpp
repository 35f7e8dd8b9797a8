// SPDX-License-Identifier: MIT
// Overrides (--set, keys of a sweep) as parts of a setup's tree: they are written into it before anything is
// read, so that one reader checks both.
#pragma once
#include <span>

#include "effect.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"
#include "toml_document.hpp"

namespace shakedown {

/// Writes a value into the tree, its place the override's; tables that it needs are made.
void write_override(TomlValue& root, const Override& override, KnownEffects known);

/// Returns, as a tree, what the setup has of keys of which an override changes only a part: effects, and one
/// component of a list.
TomlValue changed_in_part(const Setup& setup, std::span<const Override> overrides);

}  // namespace shakedown
