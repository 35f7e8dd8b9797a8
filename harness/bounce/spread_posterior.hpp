// SPDX-License-Identifier: MIT
// Belief in the numbers of a law when timing noise, scatter from impact to impact and scatter from drop to
// drop are unknown. Residuals are normal with covariance V ((1 - f) K_t + f K_s + w K_d): timing noise of
// white instants, scatter of e of each impact, scatter of e of each drop. K_t and K_s have a mean of 1 on the
// diagonal. Before the data ln V is uniform, f = 0 has probability 0.6 (no scatter) and ln(f/(1-f)) is else
// uniform from -3 to 8; w = 0 has 0.75, ln w is else uniform from -7 to 2 (drops less than three: w = 0).
// On a grid of V, f and w the law's numbers are normal and are integrated in closed form; the grid is summed.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "drop_residuals.hpp"
#include "interval.hpp"

namespace shakedown {

/// One point of the grid.
struct SpreadNode {
  double weight = 0;                     ///< of all, they sum to 1
  double timing = 0;                     ///< s, deviation of an instant
  double scatter = 0, drop_scatter = 0;  ///< deviations of e
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// A normal distribution within bounds, with a weight.
struct NormalPart {
  double weight = 0, mean = 0, deviation = 0, low = 0, high = 1;
};
/// Returns median and 95 % interval of a sum of them.
Estimate estimate_of(const std::vector<NormalPart>& parts);

/// A function of the parameters, to first order, and the bounds of its values.
struct LinearValue {
  double value = 0;
  Eigen::VectorXd slope, at;
  double low = 0, high = 1;
};

struct SpreadPosterior {
  double log_evidence = 0;
  double scatter_odds = 0;        ///< probability that e scatters from impact to impact
  double drop_scatter_odds = 0;   ///< that it does from drop to drop
  double log_evidence_still = 0;  ///< evidence with f = 0 only
  std::vector<SpreadNode> nodes;

  /// Return the posterior mean of the parameters, and their covariance within and between nodes.
  Eigen::VectorXd mean() const;
  Eigen::MatrixXd covariance() const;
  /// Adds the normal distributions of value + slope . (parameters - at), cut off at the bounds, each with its
  /// weight times `weight`.
  void add_to(std::vector<NormalPart>& parts, const LinearValue& value, double weight) const;
  /// Returns its median and 95 % interval.
  Estimate estimate(const LinearValue& value) const;
  /// Returns median and 95 % interval of a deviation, of the nodes that have one; NaN: none does.
  Estimate spread(double SpreadNode::*deviation) const;
};

/// What is known of the timing beforehand; NaN: nothing.
struct TimingKnown {
  double deviation = not_said;  ///< s, of an instant, to 10 %
  double resolution = 0;        ///< s: the noise is no less than resolution/sqrt(12)
};

/// Sums over the grid. `usual_variance`: about V, s^2, which weighs the errors of heights.
SpreadPosterior spread_posterior(const Linearised& at, const std::vector<LawParameter>& parameters,
                                 const TimingKnown& timing, double usual_variance);

/// The products of columns with the inverse of the covariance of one node.
struct WhitenedColumns {
  Eigen::MatrixXd products;  ///< (columns)^T C^-1 (columns)
  Eigen::MatrixXd solved;    ///< C^-1 columns
};
/// Computes them; `columns` has a row for each row of `at`.
WhitenedColumns whitened(const Linearised& at, const Eigen::MatrixXd& columns, const SpreadNode& node);

}  // namespace shakedown
