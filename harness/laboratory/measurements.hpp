// SPDX-License-Identifier: MIT
// Simulates a laboratory: an engine runs the damper as it truly is, a camera records it, and what comes out
// looks like an experiment. The truth stays with the caller.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine.hpp"
#include "execution.hpp"
#include "experiment.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Says how the camera and its tracking program record. A camera's errors may be effects of the setup
/// instead; both add up.
struct RecordingSettings {
  double box_noise = 0.2e-3;             ///< m, standard deviation of one frame (normal, white)
  double centre_noise = 0.5e-3;          ///< m
  double frame_rate = usual_frame_rate;  ///< Hz
  double missing = 0;                    ///< fraction of frames without positions
  double outliers = 0;                   ///< fraction of positions that jump
  double jump = 20e-3;                   ///< m, a jump is uniform within +- this
  bool centre = true;                    ///< false: the grains are not tracked

  // Errors of real cameras (Physics::Camera says what the first three do).
  double lens = 0;           ///< relative distortion 0.2 m from the optical axis
  double shutter = 0;        ///< s to read 0.4 m of track
  double near = 0;           ///< the grains are so much nearer to the lens than the marker, relative
  double wander = 0;         ///< m, standard deviation of a slow error of tracking, box and centre apart,
  double wander_time = 0.3;  ///< s, and its memory (Ornstein and Uhlenbeck)
  double trigger = 0;        ///< s, standard deviation by run of how late the clock starts
  double release = 0;        ///< m, standard deviation by run of the release displacement

  double rounding = 1e-6;  ///< m, step of the positions in the table
  /// m; of an encoder, which writes a row where the box passes a multiple of this, none while it rests. 0:
  /// the clock's frames.
  double edge = 0;
  double jitter = 0;     ///< s, standard deviation of a frame's instant about an even clock
  bool stamped = false;  ///< the table has the frames' true instants; else those of the even clock
  double start = 0;      ///< s, the clock of each run starts so long after the release
  double origin = 0;     ///< m, what the table says where the spring is relaxed
  bool declared = true;  ///< the noise stands in the experiment file
};

/// Returns what the experimenter knows, and how well: the box weighed to half a per cent, the grains to a
/// quarter, the release read on a ruler to half a millimetre, the scale from a ruler in the picture to half a
/// per cent, the clock started within two milliseconds; worse where the laboratory is worse. Values are those
/// that the user believes.
std::vector<KnownValue> usually_known(const Setup& believed, const RecordingSettings& recording);

/// Describes one run to record.
struct PlannedRun {
  std::string name;
  std::vector<Override> overrides;  ///< keys of the setup in this run, box.length among them
};

/// Returns one run a length (m), named as the paper's: L040, or L040_a, L040_b ... where a length comes more
/// than once.
std::vector<PlannedRun> runs_of_lengths(const std::vector<double>& lengths);

/// Says who measures.
struct Laboratory {
  const Engine* engine = nullptr;
  KnownEffects known;
  std::uint64_t seed = 1;  ///< of initial states and of the camera's noise
  Execution execution{};
  std::function<void(double fraction)> progress{};  ///< may be empty
};

/// Runs `truth` once for each planned run and films it: positions to recording.rounding and times to 1 us, as
/// they will stand in a table. Throws InputError for a run that does not fit or an effect that the engine
/// does not model, Interrupted.
Experiment make_measurements(const Setup& truth, const std::vector<PlannedRun>& runs,
                             const RecordingSettings& recording, const Laboratory& laboratory);

/// Writes experiment.toml and a table a run into a folder that exists. Throws FileError.
void write_measurements(const std::filesystem::path& folder, const Experiment& experiment);

}  // namespace shakedown
