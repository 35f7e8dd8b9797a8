// SPDX-License-Identifier: MIT
// Tells which of two models made one set of recordings, by the means of their simulations and by how these
// spread.
#pragma once
#include <Eigen/Core>

namespace shakedown {

/// Holds the features of all runs of an experiment, in coordinates in which those of the first model are
/// nearly independent and of unit variance. Below them each free parameter has a row for what is known of it
/// beforehand.
struct FirstModel {
  Eigen::VectorXd residual;  ///< measured less its mean
  double noise = 0;          ///< expected square of the error of that mean
  Eigen::MatrixXd free;      ///< features x parameters: changes by the free ones, which move along
  Eigen::ArrayXd variance;   ///< of each feature
  /// Holds what each simulation, filmed, leaves of the mean: simulations x features.
  Eigen::MatrixXd simulations;
  /// Squares per feature, over those expected, by which codes of one physics differ. Their likelihood falls
  /// from that of 1 as a normal distribution of which this is two standard deviations away.
  double codes_differ = 1;
};

/// Holds the other model in the same coordinates.
struct OtherModel {
  Eigen::VectorXd change;   ///< its mean less that of the first
  double noise = 0;         ///< expected square of the error of its mean
  Eigen::ArrayXd variance;  ///< of each feature
};

/// Returns ln of the likelihood of the measured features by the other model over that by the first: (mean +
/// spread) / kappa, with D the change and r the residual, both less what the free parameters take up.
/// Mean, in the variances of the other: b = D'r and a = |D|^2, the simulations' noise nu taken off both; b is
/// normal about a by the other and about 0 by the first, with the variance a + nu, so that it is a (b - a /
/// 2) / (a + nu).
/// Spread: half of the fall, from the first model to the other, of the sum of squares of r beside D, each by
/// its variance, and of the logarithms of the variances; where the squares are more than 1.5 a feature they
/// are scaled down to it. All variances of a model may be larger by one factor, at the cost that
/// `codes_differ` says, so that what is too wide everywhere says little.
/// kappa: the mean square of D'x over |D|^2, x being single simulations, at least 1: chaos is no normal
/// distribution of known covariance, and this is how much worse than such a one it is.
double log_likelihood_ratio(const OtherModel& other, const FirstModel& first);

}  // namespace shakedown
