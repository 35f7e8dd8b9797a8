// SPDX-License-Identifier: MIT
// Computes what the equation of motion leaves of recorded positions, and how that changes with each number of
// a fit.
#pragma once
#include <numbers>
#include <utility>

#include "known_effects.hpp"
#include "waveform_fit.hpp"

namespace shakedown {

inline constexpr double two_pi = 2 * std::numbers::pi;

/// Returns how many numbers a fit of these laws has: three a run, the frequency, each law's.
Eigen::Index count_of(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws);

/// Returns the setup with every law in it, at a strength that is within its bounds: put() needs them there.
Setup prepared(Setup setup, const std::vector<WaveformLaw>& laws, KnownEffects known);

/// Sets frequency (Hz) and laws of a prepared() setup from `value`, the numbers of a fit of so many runs:
/// three a run, the frequency, each law's (WaveformFit::value).
void put(Eigen::Index runs, const std::vector<WaveformLaw>& laws, const Eigen::VectorXd& value, Setup& setup);

/// Computes measured less modelled, in standard deviations, of all runs, and what is believed of the
/// frequency where something is; laid out for MINPACK's algorithm.
class Residuals {
 public:
  using Scalar = double;
  /// What is handed in must outlive it.
  Residuals(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
            const WaveformOptions& options);

  /// These are what Eigen's Levenberg and Marquardt asks for: numbers of unknowns and of residuals, residuals
  /// at scaled unknowns (0 where they can be computed), slopes.
  int inputs() const { return static_cast<int>(inputs_); }
  int values() const { return static_cast<int>(frames_) + believes(); }
  int frames() const { return static_cast<int>(frames_); }
  int operator()(const Eigen::VectorXd& scaled, Eigen::VectorXd& out) const {
    return at(value_of(scaled), out), 0;
  }
  int df(const Eigen::VectorXd& scaled, Eigen::MatrixXd& slope) const;
  /// Returns the numbers of a fit from scaled ones.
  Eigen::VectorXd value_of(const Eigen::VectorXd& scaled) const {
    return start_.array() + scaled.array() * scale_.array();
  }

  /// Fills in the residuals at these numbers, of one run alone where `only` is given. Returns false where a
  /// run cannot be simulated.
  bool at(const Eigen::VectorXd& value, Eigen::VectorXd& out, Eigen::Index only = -1) const;

  /// Sets the start, and for each number the step by which the motion changes by about its amplitude, so that
  /// all numbers are alike.
  void start_from(const Eigen::VectorXd& start);

  /// Returns the change of the residuals, `here` at `value`, per such a step of the last law's strength.
  Eigen::VectorXd slope_of_last_law(const Eigen::VectorXd& value, const Eigen::VectorXd& here) const;

  /// Returns how many frames of each run are fitted.
  const std::vector<Eigen::Index>& used() const { return used_; }
  const Eigen::VectorXd& scale() const { return scale_; }

 private:
  /// Returns the number of rows for what is known of the frequency beforehand: 1 or 0.
  int believes() const { return options_.believed_error > 0 ? 1 : 0; }
  /// Returns about the root of the sum of squares of all runs' motion, in standard deviations.
  double root_of_sum_of_squares() const;
  /// Returns the step of one number that changes the motion by about its amplitude; 0 where it does nothing.
  /// `step`: a small one, to try.
  double scale_of_number(Eigen::Index number, double step, const Eigen::VectorXd& start,
                         const Eigen::VectorXd& here) const;
  /// Fills in the residuals of one run; returns false where it cannot be simulated.
  bool of_run(std::size_t r, const Eigen::VectorXd& value, Eigen::Ref<Eigen::VectorXd> out) const;

  const std::vector<WaveformRun>& runs_;
  const std::vector<WaveformLaw>& laws_;
  const WaveformOptions& options_;
  std::vector<Setup> setups_;  ///< of each run, with all laws
  std::vector<Eigen::Index> used_;
  Eigen::Index frames_ = 0, inputs_ = 0;
  Eigen::VectorXd start_, scale_;
};

}  // namespace shakedown
