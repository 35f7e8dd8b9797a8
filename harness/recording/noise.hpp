// SPDX-License-Identifier: MIT
// Finds the noise of recorded positions from the frames alone: its size from differences of neighbouring
// frames of an order that cancels the motion, its colour from what a local polynomial leaves.
#pragma once
#include <array>
#include <vector>

#include "motion_seen.hpp"

namespace shakedown {

constexpr int colour_lags = 5;

/// How the standard deviation is known.
enum class NoiseSource {
  frames,    ///< found in the frames
  bound,     ///< from the frames too, but the motion between them may be part of it: at most this
  declared,  ///< the experiment file's, where frames cannot tell
  assumed,   ///< neither
};

/// Noise in a part of the record.
struct NoiseAt {
  double from = 0, to = 0;  ///< s
  double deviation = 0;     ///< m, of one frame
};

/// The noise of one series of positions. All numbers are finite but `declared`, `wander` and `wander_time`.
struct NoiseFound {
  double standard_deviation = 0;  ///< m, of one frame; while the box moves where it is another at rest
  NoiseSource source = NoiseSource::frames;
  int order = 4;  ///< of the differences that tell it; higher for fewer frames a period
  /// Autocorrelation at lags 1 ... 5 frames; all zero where the noise is white within its error.
  std::array<double, colour_lags> correlation{};
  /// Slow error on top, which differences do not see: m, standard deviation, and s, over which it forgets (an
  /// Ornstein-Uhlenbeck process), from stretches at rest. 0: not seen there; NaN: no such stretch.
  double wander = 0, wander_time = 0;
  double declared = 0;     ///< m; NaN: not declared
  double quantum = 0;      ///< m, step of the recorded numbers where it matters (pixel locking); 0: fine
  int outliers = 0;        ///< frames that no neighbour supports; taken as missing
  int missing = 0;         ///< blank cells and lost frames
  double longest_gap = 0;  ///< s
  std::vector<NoiseAt> over_time;  ///< where there are frames enough, in the order of time
};

/// One series of positions, and what decides how its noise is told.
struct NoiseSeries {
  const std::vector<double>* time = nullptr;  ///< s
  const std::vector<double>* x = nullptr;     ///< m, NaN where missing
  double interval = 0;                        ///< s, between frames
  std::vector<char> neighbour;   ///< for each frame: it follows the one before without a frame lost between
  std::vector<char> moving;      ///< for each frame: it tells the noise; at rest rounding may hide it
  double frames_per_period = 0;  ///< infinite where no period is seen
  bool by_clock = false;         ///< frames lie at their times, not on an even grid
  int order = 4;                 ///< of differences in which the motion cancels; 0: there is no such order
};

/// Returns a series with what decides how its noise is told. `time` (s) and `x` (m) must outlive it;
/// `interval`: s.
NoiseSeries noise_series(const std::vector<double>& time, const std::vector<double>& x, double interval);

/// Returns the autocorrelations at lags 1 ... 5 of the noise that these series have in common.
std::array<double, colour_lags> colour_of(const std::vector<NoiseSeries>& series);

/// Sets the standard deviation of one frame's noise of this colour, its source, quantum and course over time.
/// Where frames do not tell it, the declared one is taken, and without that the best bound.
void set_deviation(const NoiseSeries& series, NoiseFound& noise);

/// Returns the standard deviation, m, if the noise were white; other estimates start from it. NaN: too few
/// frames in a row.
double white_deviation(const NoiseSeries& series);

/// Returns the step in which numbers were recorded, m: the smallest gap between levels that repeats and of
/// which nearly all others are multiples; 0 where there is none.
double step_of(const std::vector<double>& x);

}  // namespace shakedown
