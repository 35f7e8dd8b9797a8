// SPDX-License-Identifier: MIT
// Tells where a hidden case stands, and whether a diagnosis would see what it hides.
#pragma once
#include <filesystem>
#include <string>

#include "experiment.hpp"
#include "trial.hpp"

namespace shakedown {

/// Returns as text for a terminal where the files of a case are. `truth`: the file with the answer.
std::string case_text(const std::filesystem::path& folder, const std::filesystem::path& truth,
                      const Experiment& experiment);
/// Returns it as JSON text.
std::string case_json(const std::filesystem::path& folder, const std::filesystem::path& truth,
                      const Experiment& experiment);

/// Returns as text for a terminal how often a diagnosis saw and named what is hidden.
std::string power_text(const HiddenCase& hidden, const Power& power);
/// Returns it as JSON text.
std::string power_json(const HiddenCase& hidden, const Power& power);

}  // namespace shakedown
