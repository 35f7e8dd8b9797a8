// SPDX-License-Identifier: MIT
#pragma once
#include "ensemble.hpp"
#include "report.hpp"
#include "running_statistic.hpp"

namespace shakedown {

/// The motion of an ensemble, collected while its runs go on (hand add() to EnsembleOptions::each; runs must
/// come in order).
class RunCurves {
 public:
  /// Adds the next run.
  void add(const Trajectory& trajectory);
  /// Makes the report. Of logged runs the first is replayed.
  Report report(const Ensemble& ensemble, const Setup& setup, const std::string& name) const;

 private:
  int runs_ = 0;
  std::vector<double> time_;
  std::array<std::vector<RunningStatistic>, 6> statistics_;  ///< x_box, x_com, energy, losses; mm, mJ
  std::vector<double> first_box_, first_centre_;
  std::shared_ptr<const CollisionLog> log_;
};

}  // namespace shakedown
