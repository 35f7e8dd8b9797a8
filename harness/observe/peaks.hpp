// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "sampled_motion.hpp"

namespace shakedown {

/// An extremum of the box's position.
struct Peak {
  double time = 0;      ///< s
  double position = 0;  ///< m, signed
};

/// Returns the times at which the position changes sign, s. Two changes closer together than `shortest` (s)
/// are a wiggle of one passage through zero, made by grains landing there, and not a half period: both are
/// left out.
std::vector<double> zero_crossings(const SampledMotion& motion, double shortest);

/// Returns the largest extremum between each zero crossing and the next: one a half period, so the small
/// double extrema where a layer of grains lands do not count twice. What comes before the first crossing is
/// the release, and is excluded; so is the half period that the record cuts short.
std::vector<Peak> largest_extrema(const SampledMotion& motion, const std::vector<double>& crossings);

/// Returns 4.5 / (t10 - t1) of the first ten zero crossings, Hz; NaN when there are fewer.
double frequency_of(const std::vector<double>& crossings);

}  // namespace shakedown
