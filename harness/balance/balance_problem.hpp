// SPDX-License-Identifier: MIT
// Makes the regression of the momentum balance of a measurement: runs on an even clock, a column for each
// strength that may be missing, the nuisances of camera and scales.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "balance_evidence.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Values of nuisances by name, SI, counted from what the setup says.
using NuisanceValues = std::map<std::string, double, std::less<>>;

/// Returns the measurement read with these values of camera and weights: what is linear about them is exact
/// there.
Measurement read_with(const Measurement& measurement, const NuisanceValues& values, KnownEffects known);

/// Tells whether the parameter scales every position alike; the balance then cannot tell it.
bool scales_all_lengths(KnownEffects known, const std::string& key);

/// Owns what the regression refers to; the measurement must outlive it.
class BalanceProblem {
 public:
  /// `already`: values of nuisances that `measurement` was read with; what is known of them holds for the
  /// whole. `only`: of these effects alone is a strength in question; empty: of all.
  BalanceProblem(const Measurement& measurement, KnownEffects known, NuisanceValues already = {},
                 const std::vector<std::string>& only = {});
  BalanceProblem(const BalanceProblem&) = delete;
  BalanceProblem& operator=(const BalanceProblem&) = delete;

  const std::vector<MomentumRun>& runs() const { return runs_; }  ///< one a measured run
  double frequency() const { return frequency_; }                 ///< Hz, of the empty box, as the setup says
  /// Returns the strengths that may be missing, the spring's first; those that leave no trace included.
  const std::vector<MomentumTerm>& terms() const { return terms_; }
  /// Returns the regression in windows of this length and hop, s. It refers to this object.
  SelectionProblem windows_of(double length, double hop) const;
  /// Returns the standard deviation of a frame's noise, m, the largest of all runs.
  double noise() const;

 private:
  /// Returns the samples of a term at this strength, one entry a run.
  std::vector<ForceSamples> samples_of(const MomentumTerm& term, double strength) const;
  MomentumRun run_with(std::size_t run, Setup setup) const;
  /// Returns the nuisances of camera and weights that leave a trace.
  std::vector<BalanceNuisance> nuisances() const;
  void add_camera(std::vector<BalanceNuisance>& list) const;
  void add_weights(std::vector<BalanceNuisance>& list) const;

  const Measurement& measurement_;
  KnownEffects known_;
  NuisanceValues already_;
  std::vector<MomentumRun> runs_;
  std::vector<MomentumTerm> seen_;   ///< every strength
  std::vector<MomentumTerm> terms_;  ///< those in question
  double frequency_ = 1, typical_sine_ = 0;
};

}  // namespace shakedown
