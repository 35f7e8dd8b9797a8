// SPDX-License-Identifier: MIT
// Describes any force of one of the kinds of ShapeOf by values on a grid: families of formulas are tried
// against these, and they are drawn when none fits.
#pragma once
#include <Eigen/Core>
#include <array>

#include "momentum.hpp"
#include "momentum_fit.hpp"

namespace shakedown {

constexpr int shape_kinds = 7;

/// Holds a whitened column of the balance for every node of a grid, for each kind, with columns that are
/// already in the fit projected out.
class ForceMap {
 public:
  /// Makes the columns of each kind, rows of `problem` x nodes; the grids reach over what the runs show of
  /// position, velocity and time. gain() and curve() need project_out() first.
  ForceMap(const MomentumProblem& problem, const std::vector<MomentumRun>& runs);

  const MotionScales& scales() const { return scales_; }  ///< of all runs together
  /// Takes fitted columns out of the map. `residual`: what their fit leaves of the whitened impulses;
  /// `orthonormal`: an orthonormal basis of theirs (orthonormal_basis()).
  void project_out(const Eigen::VectorXd& residual, const Eigen::MatrixXd& orthonormal);

  /// Returns the fall of chi2 when this shape joins; 0 where it leaves no trace.
  double gain(const ForceShape& shape, const ShapeValues& values) const;

  /// Returns a curve through the residual force; a ridge keeps it smooth.
  ForceCurve curve(ShapeOf of) const;

 private:
  struct Grid {
    double low = 0, step = 0;
    Eigen::Index nodes = 0;
    double at(Eigen::Index node) const { return low + step * static_cast<double>(node); }  ///< SI
  };
  MotionScales scales_;
  std::array<Grid, shape_kinds> grid_;
  std::array<Eigen::MatrixXd, shape_kinds> columns_;  ///< whitened
  std::array<Eigen::MatrixXd, shape_kinds> gram_;     ///< of what the fit leaves
  std::array<Eigen::VectorXd, shape_kinds> overlap_;  ///< with what the fit leaves of the impulses

  /// Returns the values of a shape at the nodes of its grid; of damping_at_x their antiderivative.
  Eigen::VectorXd node_values(const ForceShape& shape, const ShapeValues& values) const;
};

/// Returns the force of unit strength of a shape in a run, with the derivatives through which noise enters.
ForceSamples shape_samples(const ForceShape& shape, const ShapeValues& values, const MomentumRun& run);

}  // namespace shakedown
