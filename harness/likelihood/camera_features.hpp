// SPDX-License-Identifier: MIT
// What a camera that is known to an error may have done to the features of a measurement: derivatives of the
// recording itself, which cost arithmetic and no simulation.
#pragma once
#include <optional>
#include <string_view>

#include "emulator.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"
#include "nuisance.hpp"
#include "slow_wander.hpp"

namespace shakedown {

/// Of the setup: how long the picture's rows are read one after the other.
inline constexpr std::string_view shutter_key = "camera_shutter.time";

/// The features of every run, with their change by each parameter of the camera and by what each run has of
/// its own.
std::vector<MeasuredFeatures> features_with_camera(const Measurement& measurement, KnownEffects known);

/// A knob for everything of the one camera that is known to an error, about what the setup says. `shutter`:
/// value and error of the shutter's time, s, where more is known of it than the experiment says.
std::vector<Knob> camera_knobs(const Setup& setup, const Measurement& measurement, KnownEffects known,
                               const std::optional<ValueWithError>& shutter = {});

/// Covariance of the features of a run whose two tracks wander so, each by itself, m^2.
Eigen::MatrixXd wander_covariance(const FeaturePlan& plan, const Wander& wander);

/// What each run has of its own, with its tracks' wander.
void add_wander(const Wander& wander, std::vector<MeasuredFeatures>& measured);

}  // namespace shakedown
