// SPDX-License-Identifier: MIT
// From a measurement to the regression of its momentum balance: runs on an even clock, a column for each
// strength that may be missing, the nuisances of camera and scales.
#pragma once
#include <memory>
#include <span>

#include "balance_evidence.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Owns what the regression refers to.
class BalanceProblem {
 public:
  BalanceProblem(const Measurement& measurement, std::span<const EffectRecord* const> known);
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
  std::vector<BalanceNuisance> nuisances() const;
  void add_camera(std::vector<BalanceNuisance>& list) const;
  void add_weights(std::vector<BalanceNuisance>& list) const;

  const Measurement& measurement_;
  std::span<const EffectRecord* const> known_;
  std::vector<MomentumRun> runs_;
  std::vector<MomentumTerm> terms_;
  double frequency_ = 1, typical_sine_ = 0;
};

}  // namespace shakedown
