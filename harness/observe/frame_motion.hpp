// SPDX-License-Identifier: MIT
// Finds peaks and frequency of a motion of which only frames are known, few a period perhaps: each from a
// swing fitted to the frames about it.
#pragma once
#include <string>
#include <vector>

#include "peaks.hpp"

namespace shakedown {

/// Frames in a period from which on peaks are right to 1 % of the amplitude.
constexpr double least_frames_per_period = 10;

struct FrameMotion {
  std::vector<double> crossings;  ///< s, of `middle`
  std::vector<Peak> peaks;        ///< m from `middle`, one a half period, as largest_extrema gives them
  double frequency = 0;           ///< Hz, of the first ten crossings; NaN where there are fewer
  std::string why_not;            ///< why there are no peaks, for people; empty where there are
};

/// Returns peaks and frequency of a motion. `x`: m, NaN where missing, at `time`, s, increasing; wrong frames
/// taken out. `middle`: m, about which it swings. `shortest`: s, as for zero_crossings().
FrameMotion frame_motion(const std::vector<double>& time, const std::vector<double>& x, double middle,
                         double shortest);

}  // namespace shakedown
