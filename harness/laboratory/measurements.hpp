// SPDX-License-Identifier: MIT
// A laboratory that exists only here: an engine runs the damper as it truly is, a camera records it, and what
// comes out looks like an experiment. What the damper truly is stays with whoever asked.
#pragma once
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine.hpp"
#include "experiment.hpp"

namespace shakedown {

/// How the camera and its tracking program record; what the camera gets systematically wrong is an effect of
/// the setup.
struct RecordingSettings {
  double box_noise = 0.2e-3;     ///< m, standard deviation of one frame (normal, white)
  double centre_noise = 0.5e-3;  ///< m
  double frame_rate = 500;       ///< Hz
  double missing = 0;            ///< fraction of frames without positions
  double outliers = 0;           ///< fraction of positions that jump
  double jump = 20e-3;           ///< m, a jump is uniform within +- this
  bool centre = true;            ///< false: the grains are not tracked
};

/// One run to record.
struct PlannedRun {
  std::string name;
  std::vector<Override> overrides;  ///< keys of the setup in this run, box.length among them
};

/// One run a length (m), named as the paper's: L040, or L040_a, L040_b ... where a length comes more than
/// once.
std::vector<PlannedRun> runs_of_lengths(const std::vector<double>& lengths);

struct Laboratory {
  const Engine* engine = nullptr;
  std::span<const EffectRecord* const> known;
  std::uint64_t seed = 1;  ///< of initial states and of the camera's noise
  int threads = 0;         ///< 0: one a core; the measurements do not depend on it
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double fraction)> progress{};  ///< may be empty
};

/// Runs `truth` once for each planned run and records it: positions to 1 um and times to 0.1 ms, as they will
/// stand in a table. Throws InputError for a run that does not fit or an effect that the engine does not
/// model, Interrupted.
Experiment make_measurements(const Setup& truth, const std::vector<PlannedRun>& runs,
                             const RecordingSettings& recording, const Laboratory& laboratory);

/// experiment.toml and a table a run, into a folder that exists. Throws FileError.
void write_measurements(const std::filesystem::path& folder, const Experiment& experiment);

}  // namespace shakedown
