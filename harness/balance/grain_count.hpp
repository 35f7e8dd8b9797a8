// SPDX-License-Identifier: MIT
// Tells whether the grains were counted right. One fewer or more changes the mass that moves against the box,
// which a bias of the camera or a heavier blade imitates.
#pragma once
#include <span>
#include <vector>

#include "known_effects.hpp"
#include "momentum.hpp"

namespace shakedown {

/// Names another number of grains, and says how likely the recording makes it.
struct GrainCount {
  int difference = 0;   ///< from the setup's number, of every run with grains: -1 or 1
  double log_odds = 0;  ///< ln likelihood over that of the number as given, nothing missing in either
};

/// Returns one grain fewer and one more, most likely first: spring's frequency and nuisances free in each,
/// the noise as `audit` has found it. Empty where there is no balance, or a run with grains has one grain
/// alone.
std::vector<GrainCount> grain_counts(const Measurement& measurement, KnownEffects known,
                                     const MomentumAudit& audit);

/// Probability beforehand of a miscount by one, each of the two: an assumption, one experiment in fifty is
/// miscounted.
constexpr double miscounted = 0.01;

/// Returns the difference that is at least as probable as the set of effects that `audit` has found, or,
/// where it has found none, as probable as none; 0 where there is no such.
int miscount_in_question(const std::vector<GrainCount>& counts, const MomentumAudit& audit);

}  // namespace shakedown
