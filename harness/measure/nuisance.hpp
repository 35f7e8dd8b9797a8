// SPDX-License-Identifier: MIT
// What is known of camera, clock and scales, and how well: as the experiment says ([known]), else as such
// things usually are.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "known_effects.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Something of the camera that the setup takes to be perfect.
struct CameraNuisance {
  std::string key;        ///< of the effect's parameter, "camera_lens.distortion"
  std::string known_as;   ///< in [known], "camera.lens"
  std::string unit;       ///< SI
  double deviation = 0;   ///< standard deviation, SI
  bool each_run = false;  ///< every run has its own (a trigger), else one camera films all
  bool assumed = true;    ///< the experiment does not say it
};
std::vector<CameraNuisance> camera_nuisances(const Measurement& measurement,
                                             std::span<const EffectRecord* const> known);

/// A number of the setup that was weighed or measured.
struct WeighedNuisance {
  std::string key, unit;
  double deviation = 0;  ///< standard deviation, SI
  bool assumed = true;
};
std::vector<WeighedNuisance> weighed_nuisances(const Measurement& measurement);

}  // namespace shakedown
