// SPDX-License-Identifier: MIT
// Any force of one of the kinds of ShapeOf, as values on a grid: what families of formulas are tried against,
// and what is drawn when none fits.
#pragma once
#include <Eigen/Core>
#include <array>

#include "momentum.hpp"
#include "momentum_fit.hpp"

namespace shakedown {

constexpr int shape_kinds = 7;

/// A whitened column of the balance for every node of a grid, for each kind; columns that are already in the
/// fit projected out.
class ForceMap {
 public:
  ForceMap(const MomentumProblem& problem, const std::vector<MomentumRun>& runs);

  const MotionScales& scales() const { return scales_; }
  /// What is left of the impulses and of the map when `columns` are fitted.
  void project_out(const Eigen::VectorXd& residual, const Eigen::MatrixXd& orthonormal);

  /// Fall of chi2 when this shape joins.
  double gain(const ForceShape& shape, const ShapeValues& values) const;

  /// A curve through the residual force; a ridge keeps it smooth.
  ForceCurve curve(ShapeOf of) const;

 private:
  struct Grid {
    double low = 0, step = 0;
    Eigen::Index nodes = 0;
    double at(Eigen::Index node) const { return low + step * static_cast<double>(node); }
  };
  MotionScales scales_;
  std::array<Grid, shape_kinds> grid_;
  std::array<Eigen::MatrixXd, shape_kinds> columns_;  ///< whitened
  std::array<Eigen::MatrixXd, shape_kinds> gram_;     ///< of what the fit leaves
  std::array<Eigen::VectorXd, shape_kinds> overlap_;  ///< with what the fit leaves of the impulses

  Eigen::VectorXd node_values(const ForceShape& shape, const ShapeValues& values) const;
};

/// Force of unit strength of a shape in a run, with the derivatives through which noise enters.
ForceSamples shape_samples(const ForceShape& shape, const ShapeValues& values, const MomentumRun& run);

}  // namespace shakedown
