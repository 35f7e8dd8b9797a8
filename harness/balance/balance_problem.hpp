// SPDX-License-Identifier: MIT
// From a measurement to the regression of its momentum balance: runs on an even clock, a column for each
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

/// Values of nuisances by name, SI, from what the setup says.
using NuisanceValues = std::map<std::string, double, std::less<>>;

/// The measurement read with these values of camera and weights: what is linear about them is exact there.
Measurement read_with(const Measurement& measurement, const NuisanceValues& values, KnownEffects known);

/// Whether this parameter of a camera multiplies every position by the same: a balance cannot tell it, for it
/// multiplies all of that too.
bool scales_all_lengths(KnownEffects known, const std::string& key);

/// Owns what the regression refers to.
class BalanceProblem {
 public:
  /// `already`: values of nuisances that `measurement` was read with; what is known of them holds for the
  /// whole. `only`: of these effects alone is a strength in question; empty: of all.
  BalanceProblem(const Measurement& measurement, KnownEffects known, NuisanceValues already = {},
                 const std::vector<std::string>& only = {});
  BalanceProblem(const BalanceProblem&) = delete;
  BalanceProblem& operator=(const BalanceProblem&) = delete;

  const std::vector<MomentumRun>& runs() const { return runs_; }
  double frequency() const { return frequency_; }  ///< Hz, of the empty box, as the setup says
  /// The strengths that may be missing, the spring's first; those that leave no trace included.
  const std::vector<MomentumTerm>& terms() const { return terms_; }
  /// The regression in windows of this length and hop, s. Refers to this object.
  SelectionProblem windows_of(double length, double hop) const;
  /// m, standard deviation of a frame's noise, the largest of all runs.
  double noise() const;

 private:
  std::vector<ForceSamples> samples_of(const MomentumTerm& term, double strength) const;
  MomentumRun run_with(std::size_t run, Setup setup) const;
  std::vector<BalanceNuisance> nuisances() const;
  void add_camera(std::vector<BalanceNuisance>& list) const;
  void add_weights(std::vector<BalanceNuisance>& list) const;

  const Measurement& measurement_;
  KnownEffects known_;
  NuisanceValues already_;
  std::vector<Recording> motion_;  ///< of each run, before the camera
  std::vector<MomentumRun> runs_;
  std::vector<MomentumTerm> seen_;   ///< every strength
  std::vector<MomentumTerm> terms_;  ///< those in question
  double frequency_ = 1, typical_sine_ = 0;
};

}  // namespace shakedown
