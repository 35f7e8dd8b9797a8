// SPDX-License-Identifier: MIT
// Setup from and to TOML. Quantities are strings with units; a bare number where a unit is due is an error.
#pragma once
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "known_effects.hpp"
#include "setup.hpp"

namespace shakedown {

/// One override of a key from the command line, e.g. box.length="65 mm" (a bare word is taken as a string:
/// box.length=65mm works). Effects too: grain_friction.grain_wall=0.2 adds or changes that effect,
/// constant_acceleration.acceleration.x=0.1m/s^2.
struct Override {
  std::string key;
  std::string value;
  std::string origin = "--set";  ///< stands for the file in messages
};

/// Splits "key=value" at the first equals sign; throws InputError without one.
Override parse_override(std::string_view text, const std::string& origin = "--set");

/// Returns the value as a TOML file must have it: what the command line takes bare (65mm, random) in quotes.
std::string toml_value(const Override& override);

/// Reads a setup file. `known` are the effects it may name. Throws InputError with every violation at once,
/// FileError when the file cannot be read. Effects at their neutral value are dropped. Relative
/// initial_grains paths count from the file's folder, those of overrides from the working folder.
Setup read_setup(const std::filesystem::path& file, KnownEffects known,
                 std::span<const Override> overrides = {});

/// Reads a setup from text in the same way; `name` stands for the file in messages.
Setup parse_setup(std::string_view text, const std::string& name, KnownEffects known,
                  std::span<const Override> overrides = {}, const std::filesystem::path& folder = {});

/// Returns the setup with these keys set, read and checked as those of a file are; effects at their neutral
/// value are dropped. Throws InputError with every violation at once.
Setup with_overrides(Setup setup, std::span<const Override> overrides, KnownEffects known);

/// Returns one effect of a setup as TOML: [[effect]], its name and all of its parameters.
std::string write_effect(const EffectChoice& choice);

/// Returns the setup as TOML that read_setup reads back to the same setup, bit for bit.
std::string write_setup(const Setup& setup);

/// Sets one numeric key in SI, e.g. ("restitution.grain_grain", 0.8), ("grain_friction.grain_wall", 0.2) or
/// ("constant_acceleration.acceleration.x", 0.1); box.width sets both widths. An effect is added with its
/// defaults when the setup does not have it yet. Throws InputError for a key that does not exist or is out of
/// bounds.
void set_number(Setup& setup, std::string_view key, double value, KnownEffects known);

/// Returns the value of a numeric key in SI; of an effect that the setup does not have its neutral value, or
/// else its default.
double get_number(const Setup& setup, std::string_view key, KnownEffects known = {});

/// Returns everything wrong with the values of a setup built in code (a mass below zero, more grains than fit
/// ...). Nothing is concluded from the keys in `known_bad`.
std::vector<Violation> violations_of(const Setup& setup,
                                     const std::set<std::string, std::less<>>& known_bad = {});

/// Returns a short stable digest of everything that determines the results of a setup, for caches: 16
/// hexadecimal digits. Effects at their neutral value, places and names of files do not count; the contents
/// of a grain file do.
std::string digest(const Setup& setup);

}  // namespace shakedown
