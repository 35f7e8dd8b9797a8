// SPDX-License-Identifier: MIT
// Numbers with which the momentum balance decides. Those of a single step stand beside it: in
// term_prices.hpp, foretold.hpp, grain_count.hpp, balance_evidence.hpp and linear_audit.cpp.
#pragma once

namespace shakedown {

/// Effects that an experiment hides beforehand, on average: as many experiments hide nothing as hide
/// something (ln 2 = 0.7, rounded down because most hide nothing that matters).
constexpr double expected_effects = 0.5;

/// Standard deviation of a track's wander over that of a frame's white noise, beforehand: trackers fit a blob
/// to a tenth of the error of a frame and keep its bias (scale of a half-Cauchy prior).
constexpr double usual_wander = 0.1;

/// Most that a track can wander by, in standard deviations of a frame's white noise: a tracker that reads a
/// mark to a tenth of a pixel has a bias of a third of a pixel at most (half a pixel would be the next one).
constexpr double most_wander_of_noise = 3;

/// Most that a track can wander by as a share of the largest excursion, where that is more: half of what a
/// usual lens does to it (camera_lens, 0.5 %, is a term of its own). What is more is no tracker's, and
/// physics may not hide in it.
constexpr double most_wander_of_swing = 0.0025;

/// The noise of a frame is known to 2 % of its variance: it is estimated from the frames.
constexpr double error_of_noise_variance = 0.02;

}  // namespace shakedown
