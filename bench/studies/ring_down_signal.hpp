// SPDX-License-Identifier: MIT
// Finds how well a strength can be known when a ring-down is recorded: the limit that no method can pass.
#pragma once
#include <string>
#include <vector>

#include "engine.hpp"
#include "known_effects.hpp"
#include "measurements.hpp"

namespace shakedown {

/// Returns strength over its standard error (Cramer and Rao) for each of these numeric keys of the true
/// setup, from one recording of the box, when its release, start, origin, frequency and the other keys are
/// free as well. Noise: white, rounding as white noise of step / sqrt(12), jitter that the table does not
/// have times the speed, wander with its memory (whitened by Kalman's filter).
std::vector<double> signals_of(const Setup& truth, const std::vector<std::string>& keys,
                               const RecordingSettings& recording, const Engine& engine, KnownEffects known);

}  // namespace shakedown
