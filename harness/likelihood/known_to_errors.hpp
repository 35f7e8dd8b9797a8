// SPDX-License-Identifier: MIT
// Frees what is known to within an error only, for commands that judge a model as it is given: a film through
// a lens and a shutter, a track that wanders, or a box two grams heavier than was weighed, is not the model's
// mistake.
#pragma once
#include <vector>

#include "emulator.hpp"
#include "measurement.hpp"
#include "nuisance_found.hpp"
#include "refit_result.hpp"
#include "slow_wander.hpp"

namespace shakedown {

/// Holds the features of a measurement with what errors of camera, masses and releases do to them.
struct KnownToErrors {
  std::vector<MeasuredFeatures> measured;  ///< in the order of the measurement
  std::vector<Knob> of_camera;             ///< of the numbers of camera and clock, at the setup's values
  std::vector<Knob> of_damper;             ///< of the masses, likewise
};

/// Returns the features with all that. The setup is the measurement's too; `measurement` has its releases
/// where they were seen (with_measured_release()); `wander`: of its tracks.
KnownToErrors known_to_errors(const Setup& setup, const Measurement& measurement, const Wander& wander,
                              const Workshop& workshop);

/// Returns what a fit shows of the numbers of camera, clock and masses that were free in it.
std::vector<NuisanceFound> nuisances_of(const Refit& fit, KnownEffects known);

}  // namespace shakedown
