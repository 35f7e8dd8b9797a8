// SPDX-License-Identifier: MIT
// Finds from its frames alone how a recorded run begins and about which place it swings.
#pragma once
#include <vector>

#include "motion_seen.hpp"

namespace shakedown {

/// How a run begins. NaN: the frames do not tell.
struct ReleaseFound {
  double start = 0, start_error = 0;  ///< s, from when on the box moves; the first frame if it moves there
  double lead_in = 0;                 ///< s, that it rests before; 0: the record begins in the motion
  double displacement = 0, displacement_error = 0;  ///< m, at the start
  double velocity = 0, velocity_error = 0;          ///< m/s, at the start
  double time = 0, time_error = 0;                  ///< s, when the velocity was zero
  double centre = 0, centre_error = 0;              ///< m, the middle of the swings
  double rest = 0, rest_error = 0;                  ///< m, where the box rests in the end
};

/// Finds the release. `x`: m, NaN where missing, without wrong frames; `interval`: s; `deviation`: m, of one
/// frame's noise.
ReleaseFound release_found(const std::vector<double>& time, const std::vector<double>& x,
                           const MotionSeen& motion, double interval, double deviation);

}  // namespace shakedown
