// SPDX-License-Identifier: MIT
// Judges several setups by the same measurements, one beside the other.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine.hpp"
#include "execution.hpp"
#include "ladder_report.hpp"

namespace shakedown {

/// Holds a setup and the file that it was read from.
struct SetupOfFile {
  std::string file;
  Setup setup;
};

/// Says how the setups of a ladder are judged, and how much is simulated.
struct LadderOptions {
  int runs = 128;      ///< simulations of each different setup, and of each round
  bool refit = false;  ///< restitutions and frequency of each setup, so that none loses by worse numbers
  Execution execution{};
  std::function<void(double fraction)> progress{};  ///< may be empty
};

/// Returns a rung for each setup, in their order; `measurement`: of all of them, as recorded. Throws
/// InputError where the engine does not model a setup, Interrupted.
std::vector<Rung> climbed(const std::vector<SetupOfFile>& setups, const Measurement& measurement,
                          const Engine& engine, const LadderOptions& options);

/// Returns the ladder as text for a terminal, lengths in mm.
std::string climbed_text(const std::vector<Rung>& rungs, bool refitted);
/// Returns it as JSON text (harness/README.md).
std::string climbed_json(const std::vector<Rung>& rungs, bool refitted);

}  // namespace shakedown
