// SPDX-License-Identifier: MIT
// How the amplitude decays: the straight line that the paper found, against an exponential.
#pragma once
#include <limits>
#include <vector>

#include "peaks.hpp"

namespace shakedown {

constexpr double absent = std::numeric_limits<double>::quiet_NaN();  ///< "there is no such number"

/// A peak is small below this share of the release: 10 mm of the paper's 107.5 mm.
constexpr double small_share = 10 / 107.5;

/// Returns the peaks from which slope and linearity are computed: t < 8 s, up to the last one before the
/// first below `small` (m).
std::vector<Peak> peaks_of_the_decay(const std::vector<Peak>& peaks, double small);

/// Returns the time of the first peak below `small` (m), s; absent when there is none.
double first_small_peak(const std::vector<Peak>& peaks, double small);

/// |peak|(t): a + b t, A exp(-r t), and a + b t + c t^2. Numbers are absent where there
/// are fewer peaks than coefficients; errors (one standard error, from the scatter about the curve) also
/// where there are no more.
struct Decay {
  int peaks = 0;
  struct Linear {
    double intercept = absent, intercept_error = absent;  ///< m
    double slope = absent, slope_error = absent;          ///< m/s
    double rms = absent;                                  ///< m
  } linear;
  struct Exponential {
    double amplitude = absent, amplitude_error = absent;  ///< m
    double rate = absent, rate_error = absent;            ///< 1/s, positive when decaying
    double rms = absent;                                  ///< m
  } exponential;
  double curvature = absent,
         curvature_error = absent;  ///< m/s^2, 2c: 0 for a straight line, > 0 when the decay slows down
};
/// Fits the three curves to these peaks.
Decay decay_through(const std::vector<Peak>& points);

/// Fits them to peaks_of_the_decay.
Decay decay_of(const std::vector<Peak>& peaks, double small);

/// Damping over one half period, from a peak to the next.
struct HalfPeriodDamping {
  double amplitude = 0;  ///< m, mean of the two |peaks|
  double loss_per_cycle =
      0;  ///< fraction of the energy lost if a whole cycle went on like this: 1 - (|next|/|this|)^4
  /// Damping ratio of the viscously damped oscillator with the same two peaks: d / sqrt(pi^2 + d^2), d =
  /// ln(|this|/|next|).
  double equivalent_ratio = 0;
};

/// Returns one entry a half period, the first from the release (m) to peaks[0].
std::vector<HalfPeriodDamping> damping_of(double release, const std::vector<Peak>& peaks);

}  // namespace shakedown
