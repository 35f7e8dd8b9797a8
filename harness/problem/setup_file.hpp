// SPDX-License-Identifier: MIT
// Setup from and to TOML. Quantities are strings with units; a bare number where a unit is due is an error.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "setup.hpp"

namespace shakedown {

/// One override of a key from the command line, e.g. box.length="65 mm" (a bare word is taken as a string: box.length=65mm works).
struct Override {
  std::string key;
  std::string value;
};

/// Reads a setup file. `known` are the effects it may name. Throws InputError with every violation at once, FileError when the
/// file cannot be read. Effects at their neutral value are dropped. Relative initial_grains paths count from the file's folder.
Setup read_setup(const std::filesystem::path& file, std::span<const EffectRecord* const> known,
                 std::span<const Override> overrides = {});

/// The same from text; `name` stands for the file in messages.
Setup parse_setup(std::string_view text, const std::string& name, std::span<const EffectRecord* const> known,
                  std::span<const Override> overrides = {}, const std::filesystem::path& folder = {});

/// The setup as TOML that read_setup reads back to the same setup, bit for bit.
std::string write_setup(const Setup& setup);

/// Sets one numeric key in SI, e.g. ("restitution.grain_grain", 0.8) or ("grain_friction.grain_wall", 0.2); the effect is added
/// with its defaults when the setup does not have it yet. Throws InputError for a key that does not exist or is out of bounds.
void set_number(Setup& setup, std::string_view key, double value, std::span<const EffectRecord* const> known);
double get_number(const Setup& setup, std::string_view key);

/// Everything wrong with the values of a setup built in code (a mass below zero, more grains than fit ...).
std::vector<Violation> violations_of(const Setup& setup);

/// A short stable digest of everything that determines the results of a setup, for caches.
std::string digest(const Setup& setup);

}  // namespace shakedown
