// SPDX-License-Identifier: MIT
// Sampled motion as CSV: ten significant digits; a number that does not exist (the centre of no grains)
// leaves its cell empty.
#pragma once
#include <string>
#include <vector>

#include "running_statistic.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// Returns a table with the columns
/// t_s,x_box_m,v_box_m_per_s,x_com_m,total_energy_J,loss_grain_grain_J,loss_end_wall_J,loss_side_wall_J.
std::string series_csv(const Trajectory& trajectory);

/// Mean and spread of the motion over runs, without keeping the runs.
class MeanSeries {
 public:
  /// Adds a run. Runs must come in a fixed order, so that sums are the same to the last bit, and be sampled
  /// at the same times.
  void add(const Trajectory& trajectory);
  /// Returns a table with the columns t_s, then mean and sd of x_box_m, x_com_m and total_energy_J over the
  /// runs.
  std::string csv() const;

 private:
  std::vector<double> time_;
  std::vector<RunningStatistic> x_box_, x_com_, energy_;  ///< one a sample
};

/// Returns one line of comma-separated numbers, ten significant digits, NaN as an empty cell.
std::string csv_line(const std::vector<double>& numbers);

}  // namespace shakedown
