// SPDX-License-Identifier: MIT
// What one series of positions shows of its motion before any model: where it turns, its period, when it
// moves and when it rests.
#pragma once
#include <vector>

namespace shakedown {

/// A turning point, to one frame.
struct Turn {
  double time = 0;      ///< s
  double position = 0;  ///< m
};

struct MotionSeen {
  std::vector<Turn> turns;  ///< ends of swings by more than a tenth of the whole range
  double range = 0;         ///< m, of all positions but wrong ones
  double period = 0;        ///< s, of a full swing to and fro; NaN where fewer than three turns are seen
  /// For each frame the span of positions, m, within half a period (0.2 s without a period) to either side.
  std::vector<double> excursion;

  /// Frames in one period; infinite without one.
  double frames_per_period(double interval) const;
};

/// `x` in m, NaN where missing; `time` in s, increasing.
MotionSeen motion_seen(const std::vector<double>& time, const std::vector<double>& x);

}  // namespace shakedown
