// SPDX-License-Identifier: MIT
// Tells what is known of camera, clock and scales, and how well: as the experiment says ([known]), else as
// such things usually are.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "known_effects.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Something of the camera that the setup takes to be perfect.
struct CameraNuisance {
  std::string key;       ///< of the effect's parameter, "camera_lens.distortion"
  std::string known_as;  ///< in [known], "camera.lens"
  std::string unit;      ///< SI
  /// Standard deviation in each run, SI; of one camera that films all the same in all of them. 0: known
  /// exactly there.
  std::vector<double> deviation_of{};
  bool each_run = false;  ///< every run has its own (a trigger, or said of a run), else one camera films all
  double deviation() const;  ///< of the run that knows it least
};
/// Returns the errors of camera and clock that this sensor can have and that some run does not know exactly.
std::vector<CameraNuisance> camera_nuisances(const Measurement& measurement, KnownEffects known);

/// A number of the setup that was weighed or measured, of runs that have it in common.
struct WeighedNuisance {
  std::string key, unit;
  double deviation = 0;             ///< standard deviation, SI
  std::vector<std::size_t> runs{};  ///< that were weighed together
  bool of_one_run = false;          ///< said of that run alone
};
/// Returns the masses that are not known exactly. None where no run has grains: alone a mass is a stiffness.
std::vector<WeighedNuisance> weighed_nuisances(const Measurement& measurement);

/// A mass, SI, as well as it is known, whether runs have grains or not: value and standard deviation in the
/// first run.
struct ValueWithError {
  double value = 0, error = 0;
};
/// Returns the mass of this key ("box.mass") in the first run, kg. Its error is what the experiment declares,
/// or what scales usually have; zeros without runs.
ValueWithError known_mass(const Measurement& measurement, std::string_view key);

/// Returns the spring's frequency beforehand, Hz, with the error that the clock adds; nothing where it is not
/// known.
std::optional<ValueWithError> known_frequency(const Measurement& measurement);

/// The wander of the track: deviation, m, and memory, s; nothing where it is not known.
struct KnownWander {
  double deviation = 0, time = 0.3;
};
/// Returns the wander that the experiment declares (camera.wander, camera.wander_time).
std::optional<KnownWander> known_wander(const Measurement& measurement);

/// Returns the effects of the camera that the experiment knows exactly, or that its sensor cannot have, so
/// that none of them can be missing.
std::vector<std::string> exactly_known(const Measurement& measurement, KnownEffects known);

}  // namespace shakedown
