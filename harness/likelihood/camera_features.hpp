// SPDX-License-Identifier: MIT
// Computes what a camera that is known only to an error may have done to the features of a measurement. These
// changes are derivatives of the recording itself: they cost arithmetic and no simulation.
#pragma once
#include <optional>
#include <string_view>

#include "emulator.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"
#include "nuisance.hpp"
#include "slow_wander.hpp"

namespace shakedown {

/// Returns the features of every run, with their change by each parameter of the camera (by_camera) and by
/// what each run has of its own (own).
std::vector<MeasuredFeatures> features_with_camera(const Measurement& measurement, KnownEffects known);

/// Returns a knob for each number of the camera that all runs share and that is known to an error, centred at
/// the setup's value; where clock and shutter are known to errors, one more for how late all runs are seen
/// together. `shutter`: value and error of the shutter's time, s, where more is known of it than the
/// experiment says.
std::vector<Knob> camera_knobs(const Setup& setup, const Measurement& measurement, KnownEffects known,
                               const std::optional<ValueWithError>& shutter = {});

/// Returns the covariance, m^2, of the features of a run whose two tracks (box and centre) wander like this,
/// each by itself.
Eigen::MatrixXd wander_covariance(const FeaturePlan& plan, const Wander& wander);

/// Adds the wander of its tracks to what each run has of its own (MeasuredFeatures::own).
void add_wander(const Wander& wander, std::vector<MeasuredFeatures>& measured);

}  // namespace shakedown
