// SPDX-License-Identifier: MIT
// Finds the slow error of a tracker, below what differences of neighbouring frames can see, from stretches at
// rest.
#pragma once
#include <vector>

#include "motion_seen.hpp"

namespace shakedown {

/// An Ornstein-Uhlenbeck process: autocovariance deviation^2 exp(-lag / time).
struct Wander {
  double deviation = 0;  ///< m; 0: not seen; NaN: no stretch at rest is long enough to tell
  double time = 0;       ///< s; 0 and NaN likewise
};

/// First and one past the last frame of a stretch at rest.
struct RestStretch {
  std::size_t first = 0, end = 0;
};

/// Returns the stretches in which the box rests before it starts and after it has stopped: its excursion
/// stays within `still`, m. None where it never moves.
std::vector<RestStretch> rests_of(const MotionSeen& motion, double still);

/// Finds the wander in these stretches of the series (m, NaN where missing; time in s). What still swings
/// there with about this period, s (NaN: none), is no wander.
Wander wander_at_rest(const std::vector<double>& time, const std::vector<double>& x,
                      const std::vector<RestStretch>& rests, double period);

}  // namespace shakedown
