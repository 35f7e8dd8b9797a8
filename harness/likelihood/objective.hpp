// SPDX-License-Identifier: MIT
// Defines what a fit makes small, -2 ln likelihood of the knobs' values, and searches for its minimum.
#pragma once
#include <Eigen/Core>

#include "emulator.hpp"

namespace shakedown {

/// -2 ln likelihood: |w - G phi(z)|^2 summed over the runs, a quadratic form in the regression's terms, with
/// the emulator's own error in the variance (without it, noise in G makes every knob seem to matter and the
/// middle of the box a minimum), and what is known of the knobs beforehand.
struct Objective {
  const std::vector<Knob>* knobs;
  Eigen::MatrixXd square;  ///< sum of G'G, terms x terms
  Eigen::VectorXd cross;   ///< sum of G'w
  double constant = 0;     ///< sum of w'w
  double degrees = 1;      ///< expected sum without emulator error
  Eigen::MatrixXd error =
      {};  ///< phi' error phi is what the emulator's error adds to the expectation; empty: none

  /// Returns |w - G phi|^2 summed over the runs. `phi`: terms of the regression (regression_terms()).
  double sum(const Eigen::VectorXd& phi) const {
    return phi.dot(square * phi) - 2 * cross.dot(phi) + constant;
  }
  /// Returns the variance with the emulator's error over the variance without.
  double inflation(const Eigen::VectorXd& phi) const {
    return error.size() == 0 ? 1.0 : 1 + phi.dot(error * phi) / degrees;
  }
  /// Returns the sum with the emulator's share taken off. Its error adds to what a wrong model leaves and
  /// does not multiply it: were it divided out, a misfit of many times the degrees would be least where the
  /// emulator knows least.
  double true_sum(const Eigen::VectorXd& phi) const;
  /// Returns true_sum and disbelief together: comparable between boxes and with pseudo-experiments.
  double chi2(const Eigen::VectorXd& z) const;
  /// Returns what the knobs' values cost by what is known of them beforehand.
  double disbelief(const Eigen::VectorXd& z) const;
  /// Returns what the fit makes small at z (in widths of the knobs): chi2 and the logarithm of the emulator's
  /// share of the variance.
  double operator()(const Eigen::VectorXd& z) const;
};

/// Holds the lowest point that a search found.
struct Minimum {
  Eigen::VectorXd z;
  double value;
};

/// Returns the lowest point within `farthest` of the scattered box's middle (box: 1) and within the knobs'
/// bounds, of searches from so many starts, the first at `first` (empty: the middle). Exact knobs are held by
/// their bounds alone.
Minimum minimum_of(const Objective& objective, double farthest, int starts,
                   const Eigen::VectorXd& first = {});

}  // namespace shakedown
