// SPDX-License-Identifier: MIT
// Reads and writes the file of stored intervals for the check on the linear decay.
#pragma once
#include <filesystem>
#include <vector>

#include "linear_decay.hpp"

namespace shakedown {

/// Returns `share/shakedown/linear_decay.json` of an installed program, else
/// harness/crosscheck/baselines/linear_decay.json of the source that this program was built from.
std::filesystem::path default_decay_baselines();

/// Reads the baselines. Throws FileError for a file that cannot be read, InputError for contents that are not
/// such baselines.
std::vector<DecayBaseline> read_decay_baselines(const std::filesystem::path& file);

/// Writes the baselines. Throws FileError.
void write_decay_baselines(const std::filesystem::path& file, const std::vector<DecayBaseline>& baselines);

/// Returns the entry of this engine and length (m), or nullptr.
const DecayBaseline* find_baseline(const std::vector<DecayBaseline>& baselines, const std::string& engine,
                                   double length);

/// Puts `fresh` in place of the entries of the same engine and length; returns all sorted by engine, then
/// length.
std::vector<DecayBaseline> updated(std::vector<DecayBaseline> baselines,
                                   const std::vector<DecayBaseline>& fresh);

/// Returns {schema_version, passed, checks: [{engine, length_mm, check, passed, value, allowed, remark}]}.
std::string decay_checks_json(const std::vector<DecayCheck>& checks);

}  // namespace shakedown
