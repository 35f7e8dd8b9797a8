// SPDX-License-Identifier: MIT
// The noise of recorded positions, from the frames alone: its size from 4th differences, its colour from what
// a local cubic leaves.
#pragma once
#include <array>
#include <vector>

namespace shakedown {

constexpr int colour_lags = 5;

/// The noise of one series of positions.
struct NoiseFound {
  double standard_deviation = 0;  ///< m, of one frame; from the median absolute deviation of 4th differences
  /// Autocorrelation at lags 1 ... 5 frames; all zero where the noise is white within its error.
  std::array<double, colour_lags> correlation{};
  double declared = 0;     ///< m; NaN: not declared
  double quantum = 0;      ///< m, step of the recorded numbers where it matters (pixel locking); 0: fine
  int outliers = 0;        ///< frames that no neighbour supports; taken as missing
  int missing = 0;         ///< blank cells and lost frames
  double longest_gap = 0;  ///< s
};

/// One series and, for each of its frames, whether it follows the one before without a frame lost between.
struct NeighbouredSeries {
  const std::vector<double>* x = nullptr;  ///< m, NaN where missing
  std::vector<char> neighbour;
};

/// Autocorrelations at lags 1 ... 5 of the noise that these series (frames `interval` s apart) have in
/// common.
std::array<double, colour_lags> colour_of(const std::vector<NeighbouredSeries>& series, double interval);

/// Standard deviation, m, of one frame's noise of this colour; `quantum` is set where the numbers come in
/// steps.
void set_deviation(const NeighbouredSeries& series, NoiseFound& noise);

/// From 4th differences as if the noise were white, m: the start of everything else.
double white_deviation(const NeighbouredSeries& series);

}  // namespace shakedown
