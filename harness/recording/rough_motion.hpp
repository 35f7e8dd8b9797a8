// SPDX-License-Identifier: MIT
// Describes the motion of one recording in rough numbers, from positions alone: no model and no unit is
// trusted.
#pragma once
#include <vector>

namespace shakedown {

/// Rough numbers of a motion; NaN where the recording is too short or too poor to tell.
struct RoughMotion {
  double frequency;     ///< Hz, from the turning points
  double amplitude;     ///< m, of the first half swing
  double centre;        ///< m, about which it swings: what alternating turning points have in common
  double centre_error;  ///< m
  double first;         ///< m, mean of the first frames
  double noise;         ///< m, of one frame, from neighbours
  double lead_in;       ///< s from the first frame until it leaves where it rested; 0: it moves at once
  double start_delay;   ///< s that a swing from rest would have taken to the first frame's speed
  double delay_error;   ///< s
  double unbroken;      ///< share of the recording's time in stretches of five frames and more without a gap
  /// Hz, of the first whole swing after the first half: the free one, where a force drives the box later at
  /// its own frequency.
  double first_frequency;
};

/// Finds them. `time`: s, increasing; `x`: m, NaN where missing.
RoughMotion rough_motion(const std::vector<double>& time, const std::vector<double>& x);

/// Returns how far a position is from swinging like a spring's: rms of x(t - T/6) + x(t + T/6) - x(t) by the
/// rms of x, both about `centre`; 0 for a sine of that frequency (Hz), NaN when it cannot be told.
double distance_from_sine(const std::vector<double>& time, const std::vector<double>& x, double frequency,
                          double centre);

}  // namespace shakedown
