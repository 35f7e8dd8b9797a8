// SPDX-License-Identifier: MIT
// Finds where a model fails: parts of an experiment (a stretch of time of one run, a phase of the swing, a
// range of amplitudes, landings) whose residuals are larger than chaos and camera noise make them, with the
// number of parts looked at allowed for.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "emulator.hpp"

namespace shakedown {

/// Holds features of an experiment that belong together.
struct Cell {
  std::string run;         ///< empty: all runs
  std::string observable;  ///< "box" or "grain centre"
  std::string
      what;  ///< "time", "phase", "amplitude", "landing", "flight" or "whole run", with its range in words
  double from = 0, to = 0;  ///< s; 0 and 0 where the cell is no stretch of time
  std::vector<std::pair<std::size_t, Eigen::Index>> features;  ///< run and place in its features
};

/// Returns every cell with four features at least: each run whole and in stretches of 2 s; of all runs
/// together octants of the swing's phase, amplitudes above 60, 30, 10 and below 10 % of the run's largest,
/// grains near an end wall (landing) or on their way (flight).
std::vector<Cell> cells_of(const std::vector<MeasuredFeatures>& measured);

/// Says how badly the model fails in a cell.
struct FailureCell {
  std::string run, observable, what;
  double from = 0, to = 0;  ///< s
  double error = 0;         ///< m, rms
  double sigmas =
      0;  ///< excess of its squares over their mean, in standard deviations, both from pseudo-experiments
  double p_value = 1;  ///< family-wise: share of pseudo-experiments with any cell that bad
};

/// Returns the sum of squares of residual over spread in each cell. `residuals`, `spreads`: one vector a run,
/// m, in the order of the run's features.
Eigen::VectorXd cell_sums(const std::vector<Cell>& cells, const std::vector<Eigen::VectorXd>& residuals,
                          const std::vector<Eigen::VectorXd>& spreads);

/// Returns the cells judged, worst first. `residuals`, `spreads`: as of cell_sums(); `pseudo`: cell sums of
/// pseudo-experiments, experiments x cells.
std::vector<FailureCell> judge_cells(const std::vector<Cell>& cells,
                                     const std::vector<Eigen::VectorXd>& residuals,
                                     const std::vector<Eigen::VectorXd>& spreads,
                                     const Eigen::MatrixXd& pseudo);

}  // namespace shakedown
