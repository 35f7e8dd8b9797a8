// SPDX-License-Identifier: MIT
// Every number with which the momentum balance decides.
#pragma once

namespace shakedown {

/// Effects that an experiment hides beforehand, on average: as many experiments hide nothing as hide
/// something (ln 2 = 0.7, rounded down because most hide nothing that matters).
constexpr double expected_effects = 0.5;

/// Standard deviation of a track's wander over that of a frame's white noise, beforehand: trackers fit a blob
/// to a tenth of the error of a frame and keep its bias (scale of a half-Cauchy prior).
constexpr double usual_wander = 0.1;

/// The noise of a frame is known to 2 % of its variance: it is estimated from the frames.
constexpr double error_of_noise_variance = 0.02;

}  // namespace shakedown
