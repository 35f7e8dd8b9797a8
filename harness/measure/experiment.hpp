// SPDX-License-Identifier: MIT
// What was measured: one experiment is several runs of one damper, each a table that nobody has touched.
#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "known_value.hpp"
#include "setup_file.hpp"

namespace shakedown {

/// How a run begins. From rest at release.displacement, or anywhere in the motion with a position and a speed
/// of its own; when not said: anywhere for an empty box, else from rest (starts_anywhere decides).
enum class Start { not_said, from_rest, anywhere };

/// One recorded run. Lab frame, x = 0 where the spring is relaxed, +x towards the release.
struct MeasuredRun {
  std::string name;  ///< file name without folder and ending; with "#2" ... where a file is used twice
  std::string file;
  double box_length = 0;                      ///< m; NaN: as in the setup
  double frame_rate = 0;                      ///< Hz, as stated, else the inverse of the median interval
  std::vector<Override> overrides;            ///< setup keys of this run, box.length among them
  std::map<std::string, SourcePlace> places;  ///< where the experiment file gives each override
  std::vector<KnownValue> known;  ///< of this run alone; goes before the experiment's of the same key
  Start start = Start::not_said;
  SourcePlace place;  ///< of its [[run]] in the experiment file

  /// m, standard deviation of release.displacement, where the first frames or `[known]` tell it; 0: exact.
  double release_error = 0;
  /// m, where the box was when the grains of release.initial_grains were measured; nothing: at
  /// release.displacement.
  std::optional<double> grains_measured_at;

  bool release_stated = false;  ///< the file says when it was let go
  bool origin_stated =
      false;  ///< the file says where x_box is 0; else what the table calls 0 is taken for it

  // One entry a frame, in the order of time.
  std::vector<double>
      time;  ///< s since release, strictly increasing; frames that were lost are simply absent
  std::vector<double> x_box;  ///< m; NaN where the position is missing
  std::vector<double> x_com;  ///< m, mass-weighted mean of the grains; NaN where missing; empty: not measured

  /// Frames before the stated release, clock and origin as above: the box at rest, or held.
  struct LeadIn {
    std::vector<double> time, x_box, x_com;
  } lead_in;

  // Declared standard deviation of one frame, m; NaN: not declared.
  double box_uncertainty = std::numeric_limits<double>::quiet_NaN();
  double com_uncertainty = std::numeric_limits<double>::quiet_NaN();

  bool has_com() const { return !x_com.empty(); }  ///< whether the grains' centre was tracked
};

/// What the positions were measured with. Only a camera has a lens, a shutter and a line of sight.
enum class Sensor { camera, encoder, ranger, gyro, other };

struct Experiment {
  std::string title;
  std::string file;
  std::vector<MeasuredRun> runs;
  std::vector<KnownValue> known;   ///< what was weighed and measured, and how well
  std::vector<std::string> notes;  ///< what was assumed in reading, in words
  Sensor sensor = Sensor::camera;
};

/// Returns the frames a second by the median interval of these times (s); 0: fewer than two.
double typical_rate(const std::vector<double>& time);

/// Tells whether the first position and speed of the run are its own: it says release = "unknown", or says
/// nothing and its box is empty. `setup` is that of the run.
bool starts_anywhere(const MeasuredRun& run, const Setup& setup);

/// Returns what is known of one run: its own values, and the experiment's where it has none.
std::vector<KnownValue> known_of(const Experiment& experiment, const MeasuredRun& run);

}  // namespace shakedown
