// SPDX-License-Identifier: MIT
// Reads what is hidden in synthetic measurements, as people write it.
#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "setup_file.hpp"
#include "trial.hpp"

namespace shakedown {

/// Holds the question. Texts are those of the options of `shakedown hide`.
struct HiddenQuestion {
  /// Returns what the user believes, with these keys changed. Throws InputError.
  std::function<Setup(std::span<const Override> changes)> setup_with;
  std::string engine = "soft", lengths = "40mm,40mm,65mm,85mm,104mm", duration, title;
  std::vector<std::string> effects, parameters, camera, runs, known;
  std::uint64_t seed = 1;
  int threads = 0;
};

/// Returns what is measured and how. Throws InputError with everything that is wrong.
Trial trial_of(const HiddenQuestion& question);

/// Returns the trial's measurements. Throws InputError where the engine does not model the truth,
/// Interrupted.
Experiment measured(const HiddenQuestion& question, const Trial& trial, const std::atomic<bool>* stop,
                    const std::function<void(double fraction)>& progress);

/// First line of the setup.toml of a case, by which an earlier case is known.
constexpr const char* first_line_of_case =
    "# What the user believes; box.length is replaced by each run's.\n";

/// Writes setup.toml with what the user believes, experiment.toml and a table a run, into a folder that
/// exists, and the answer into the file `truth`. Throws FileError.
void write_case(const std::filesystem::path& folder, const std::filesystem::path& truth,
                const HiddenQuestion& question, const Trial& trial, const Experiment& experiment);

}  // namespace shakedown
