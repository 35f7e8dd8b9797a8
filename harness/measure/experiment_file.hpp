// SPDX-License-Identifier: MIT
// The experiment file says which table is which run, which column is what, and in which unit. The tables
// themselves stay untouched.
#pragma once
#include <filesystem>
#include <string_view>

#include "experiment.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Reads an experiment file and its tables. Throws InputError with every violation at once (those of the
/// tables with their line), FileError when a file cannot be read. Paths of tables and initial_grains count
/// from the experiment file's folder. harness/measure/README.md has the reference of all keys ("Every key").
/// `effects`: those whose numbers [known] may say.
Experiment read_experiment(const std::filesystem::path& file, KnownEffects effects = {});

/// Reads an experiment from text in the same way; tables are looked for in `folder`, `name` stands for the
/// file in messages.
Experiment parse_experiment(std::string_view text, const std::string& name,
                            const std::filesystem::path& folder, KnownEffects effects = {});

/// Returns a short digest of what was measured and in which setups: it changes with any number.
std::string digest(const Experiment& experiment);

}  // namespace shakedown
