// SPDX-License-Identifier: MIT
// What a fit makes small: the likelihood of the knobs' values, and the search for its minimum.
#pragma once
#include <Eigen/Core>

#include "emulator.hpp"

namespace shakedown {

/// -2 ln likelihood: |w - G phi(z)|^2 summed over the runs, a quadratic form in the regression's terms, with
/// the emulator's own error in the variance (without it, noise in G makes every knob seem to matter and the
/// middle of the box a minimum), and what is known of the knobs beforehand.
struct Objective {
  const std::vector<Knob>* knobs;
  Eigen::MatrixXd square;
  Eigen::VectorXd cross;
  double constant = 0;
  double degrees = 1;  ///< expected sum without emulator error
  Eigen::MatrixXd error =
      {};  ///< phi' error phi is what the emulator's error adds to the expectation; empty: none

  double sum(const Eigen::VectorXd& phi) const {
    return phi.dot(square * phi) - 2 * cross.dot(phi) + constant;
  }
  /// Variance with the emulator's error over the variance without.
  double inflation(const Eigen::VectorXd& phi) const {
    return error.size() == 0 ? 1.0 : 1 + phi.dot(error * phi) / degrees;
  }
  /// The sum with the emulator's share taken off. Its error adds to what a wrong model leaves, it does not
  /// multiply it: divided by, a misfit of many times the degrees would be least where the emulator knows
  /// least.
  double true_sum(const Eigen::VectorXd& phi) const;
  /// true_sum and disbelief: comparable between boxes and with pseudo-experiments.
  double chi2(const Eigen::VectorXd& z) const;
  /// What the knobs' values cost by what is known of them beforehand.
  double disbelief(const Eigen::VectorXd& z) const;
  double operator()(const Eigen::VectorXd& z) const;
};

struct Minimum {
  Eigen::VectorXd z;
  double value;
};

/// The lowest point within `farthest` of the scattered box's middle (box: 1) and within the knobs' bounds,
/// from several starts, the first at `first` (empty: the middle).
Minimum minimum_of(const Objective& objective, double farthest, int starts,
                   const Eigen::VectorXd& first = {});

}  // namespace shakedown
