// SPDX-License-Identifier: MIT
// What the equation of motion leaves of recorded positions, and how that changes with each number of a fit.
#pragma once
#include <numbers>
#include <utility>

#include "known_effects.hpp"
#include "waveform.hpp"

namespace shakedown {

inline constexpr double two_pi = 2 * std::numbers::pi;

/// Numbers of a fit of these laws: three a run, the frequency, each law's.
Eigen::Index count_of(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws);

/// The setup with every law in it, at a strength that is within its bounds.
Setup prepared(Setup setup, const std::vector<WaveformLaw>& laws, KnownEffects known);

/// Sets frequency and laws, which the setup has, from the values of a fit of so many runs.
void put(Eigen::Index runs, const std::vector<WaveformLaw>& laws, const Eigen::VectorXd& value, Setup& setup);

/// Measured less modelled, in standard deviations, of all runs, and what is believed of the frequency where
/// something is; laid out for MINPACK's algorithm.
class Residuals {
 public:
  using Scalar = double;
  /// What is handed in must outlive it.
  Residuals(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
            const WaveformOptions& options);

  /// What Eigen's Levenberg and Marquardt asks for: numbers of unknowns and of residuals, residuals at scaled
  /// unknowns (0 where they can be computed), slopes.
  int inputs() const { return static_cast<int>(inputs_); }
  int values() const { return static_cast<int>(frames_) + believes(); }
  int frames() const { return static_cast<int>(frames_); }
  int operator()(const Eigen::VectorXd& scaled, Eigen::VectorXd& out) const {
    return at(value_of(scaled), out), 0;
  }
  int df(const Eigen::VectorXd& scaled, Eigen::MatrixXd& slope) const;
  Eigen::VectorXd value_of(const Eigen::VectorXd& scaled) const {
    return start_.array() + scaled.array() * scale_.array();
  }

  /// Only of one run where `only` is given. False where a run cannot be simulated.
  bool at(const Eigen::VectorXd& value, Eigen::VectorXd& out, Eigen::Index only = -1) const;

  /// Steps by which the motion changes by about its amplitude, so that all numbers are alike.
  void start_from(const Eigen::VectorXd& start);

  /// Change of the residuals, `here` at `value`, per such a step of the last law's strength.
  Eigen::VectorXd slope_of_last_law(const Eigen::VectorXd& value, const Eigen::VectorXd& here) const;

  /// Frames of each run.
  const std::vector<Eigen::Index>& used() const { return used_; }
  const Eigen::VectorXd& scale() const { return scale_; }

 private:
  int believes() const { return options_.believed_error > 0 ? 1 : 0; }
  double root_of_sum_of_squares() const;
  double scale_of_number(Eigen::Index number, double step, const Eigen::VectorXd& start,
                         const Eigen::VectorXd& here) const;
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
