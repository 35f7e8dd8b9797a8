// SPDX-License-Identifier: MIT
// Reads from one series of positions, before any model, where the motion turns, its period, when it moves and
// when it rests.
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
  /// The span of positions, m, within half a period (0.2 s without a period) to either side of each frame.
  std::vector<double> excursion;

  /// Returns the frames in one period, `interval` (s) apart; infinite without a period.
  double frames_per_period(double interval) const;
};

/// The box moves where its excursion exceeds this share of the whole range.
constexpr double moving_share = 0.05;

/// Reads the motion from `x` in m, NaN where missing, at `time` in s, increasing.
MotionSeen motion_seen(const std::vector<double>& time, const std::vector<double>& x);

}  // namespace shakedown
