// SPDX-License-Identifier: MIT
// Finds which law of restitution the drops follow, with what numbers, whether it holds, and which impacts are
// odd.
#pragma once
#include <string>
#include <vector>

#include "spread_posterior.hpp"

namespace shakedown {

struct BounceOptions {
  double gravity = 9.81;  ///< m/s^2
  Ball ball{};  ///< not known: restitutions hold what the air takes, and air of unknown drag is a hypothesis
  double height_error = 0.01;  ///< m, common to all heights
  TimingKnown timing{};
  double reference = 0;  ///< m/s; 0: the middle of the measured speeds (of their logarithms), two digits
};

/// A law with or without air of unknown drag.
struct LawFit {
  BounceModel model;
  std::vector<LawParameter> parameters;
  Linearised at;  ///< at the mean
  SpreadPosterior posterior;
  double probability = 0;
  double probability_still = 0;  ///< the part of it without scatter from impact to impact
  std::vector<Estimate> values;  ///< of the parameters

  std::string name() const;  ///< "power", "power and air"
  /// Returns the restitution of the law at a speed (m/s), with its 95 % interval.
  Estimate restitution_at(double speed) const;
  /// Returns the restitution at a speed (m/s) as a function of the parameters, to first order about `at`,
  /// within 0 and 1 (2 for the free curve).
  LinearValue linear_at(double speed) const;
};

/// What one law leaves beside free curves through the same impacts.
struct LawTest {
  double chi2 = 0;     ///< of the law, with the spreads found
  double degrees = 0;  ///< of freedom
  double gain = 0;     ///< fall of chi2 by bends that the law has not
  int bends = 0;
  double p_value = not_said;  ///< of that gain (F test); NaN: too few impacts
  /// chi2 of the law a degree of freedom with the timing noise stated beforehand alone; NaN: none was stated.
  double chi2_by_timing = not_said;
};

struct BounceAnswer {
  std::vector<LawFit> laws;    ///< most probable first
  LawTest test;                ///< of the first
  std::vector<LawTest> tests;  ///< of each law
  std::vector<Outlier> outliers;
  std::vector<Flights> flights;                        ///< as used
  double slowest = 0, fastest = 0, reference = 0;      ///< m/s
  double scatter_odds = 0, drop_scatter_odds = 0;      ///< averaged over the laws
  double holds_above = 0.01;                           ///< p-value
  const LawFit& best() const { return laws.front(); }  ///< the most probable; there must be one
  /// Tells whether the first law holds: it is no free curve, and its p-value is above `holds_above` or not
  /// known.
  bool holds() const;
  /// Returns the restitution at a speed (m/s) averaged over the laws, each with its probability.
  Estimate averaged_at(double speed) const;
};

/// Weighs all laws on the drops. Needs three intervals in a row, or two after a known height, in one drop at
/// least; else throws InputError naming the file.
BounceAnswer choose_law(const std::vector<Drop>& drops, const BounceOptions& options);

/// Fits one law to flights.
LawFit fit_law(const std::vector<Flights>& flights, const BounceModel& model, const TimingKnown& timing);

/// Returns impacts and instants that a fit did not expect, the worst first: candidates, of which chance alone
/// makes `by_chance`.
std::vector<Outlier> odd_ones(const LawFit& fit, double by_chance);

/// Returns the probability that chance makes one this odd, by the spreads of a fit without it, averaged over
/// what that fit leaves open; for all impacts and instants together (Bonferroni).
double chance_of(const Outlier& odd, const LawFit& fit, const LawFit& without);

/// Tests a fitted law, with what is known of the timing.
LawTest test_of(const LawFit& fit, const TimingKnown& timing);

}  // namespace shakedown
