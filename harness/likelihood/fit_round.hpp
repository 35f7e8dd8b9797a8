// SPDX-License-Identifier: MIT
// One round of a fit: what a batch of scattered simulations tells of the measured runs, and what can be asked
// of it.
#pragma once
#include <Eigen/Cholesky>
#include <vector>

#include "objective.hpp"
#include "random.hpp"
#include "refit.hpp"

namespace shakedown {

/// How far out of the scattered box (1) a solution may lie before the box follows.
constexpr double reach = 1.5;

/// One measured run, whitened.
struct Whitened {
  Eigen::LLT<Eigen::MatrixXd> root;
  Eigen::MatrixXd model;  ///< L^-1 times the emulator's coefficients, features x terms
  Eigen::VectorXd spread;
  double chaos =
      0;  ///< mean square of a simulation's whitened chaos, from simulations that the covariance has not seen
  double expected = 0;    ///< of the whitened sum: chaos and camera noise
  Eigen::MatrixXd own{};  ///< covariance^-1 times MeasuredFeatures::own
  double codes = 0;       ///< m^2, variance of what two codes of one physics differ by
};

/// What recordings that the model itself makes leave when the model is fitted to them.
struct PseudoExperiments {
  std::vector<double> sums;              ///< chi2 of each
  Eigen::MatrixXd cell_rows;             ///< experiments x cells (failure_cells.hpp)
  std::vector<Eigen::ArrayX2d> squares;  ///< m^2, of each run: experiments x (box, centre), mean squares
};

/// By which covariance a run's residual is judged.
struct JudgingRule {
  Eigen::LLT<Eigen::MatrixXd> root;
  double expected = 0;  ///< of the whitened sum
};

class FitRound {
 public:
  /// `measured` and `knobs` must outlive it. The first half of each emulator's simulations gives the weights.
  FitRound(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
           std::vector<Emulator> emulators, const RefitOptions& options);

  const Objective& objective() const { return objective_; }
  const std::vector<Knob>& knobs() const { return knobs_; }

  /// Linear emulators about z, of simulations made there (regressions on nothing) and this round's slopes, by
  /// one width of each knob.
  std::vector<Emulator> recentred(const Eigen::VectorXd& z, std::vector<Emulator> there) const;
  /// These straight emulators about z instead of where they stand.
  std::vector<Emulator> moved_to(const Eigen::VectorXd& z) const;
  Eigen::VectorXd model(std::size_t r, const Eigen::VectorXd& z) const;

  /// The smallest sum over pseudo-experiments: the model at z, a simulation that the covariance has not seen
  /// for each run, and camera noise. Their errors are the floors of the runs in `result`, which comparison()
  /// has made.
  void calibrate(const Eigen::VectorXd& z, double observed, Refit& result) const;

  /// Predicts each box length from the others, with the same simulations.
  void hold_out(Refit& result, const std::vector<JudgingRule>& rules) const;

  /// Covariance of the fitted z, the sandwich A^-1 B A^-1. A: the sensitivities' square less what the
  /// emulator's error adds to it (second derivatives times residuals are mostly noise of the emulator). B:
  /// what chaos that the weights have not seen, camera noise and the emulator's error make of the gradient;
  /// weights that are far from the best make B larger than A. A direction that the data leave open gets the
  /// size of the searched box.
  Eigen::MatrixXd covariance_at(const Eigen::VectorXd& z, double open) const;

  /// Covariance of the fitted z from the emulators' own noise, by the jackknife: what simulations left out do
  /// to the minimum near z. To first order covariance_at() has it; along a valley, where noise makes the
  /// slope, it is more.
  Eigen::MatrixXd emulator_scatter(const Eigen::VectorXd& z) const;

  /// A run's chi2 by another fit's rule, the emulator's own error taken off.
  double judged_chi2(std::size_t r, const Eigen::VectorXd& z, const JudgingRule& rule) const;

  /// The rules of `other`, or of this round where there is none.
  std::vector<JudgingRule> rules_of(const Refit* other) const;

  /// Of each measured run's features, m^2.
  std::vector<Eigen::MatrixXd> covariances() const;
  /// covariance_for_means() of all simulations, with what each run has of its own.
  std::vector<Eigen::MatrixXd> for_means(double model_error) const;

  /// Run r at the solution z, in widths of the knobs.
  RunComparison comparison(std::size_t r, const Eigen::VectorXd& z) const;

  /// Its errors and what they are uncertain by; `covariance` of z as covariance_at() has it.
  std::vector<Validation> validation(const RunComparison& run, std::size_t r, const Eigen::VectorXd& z,
                                     const Eigen::MatrixXd& covariance) const;

 private:
  std::vector<Eigen::VectorXd> measured_values() const;

  std::vector<Eigen::VectorXd> spreads() const;

  /// Features of a run that the model at z makes: a simulation that the covariance has not seen, filmed.
  Eigen::VectorXd drawn(std::size_t r, const Eigen::VectorXd& z, Random& random) const;
  PseudoExperiments made_by_the_model(const Eigen::VectorXd& z, const std::vector<Cell>& cells) const;
  /// From the mean squares of box and centre that pseudo-experiments leave.
  void set_floors(std::size_t r, const Eigen::VectorXd& z, const Eigen::ArrayX2d& squares,
                  RunComparison& run) const;

  /// A residual less what the run has of its own (release, clock, an origin that nobody stated, the track's
  /// wander), as far as the run itself tells it.
  Eigen::VectorXd without_own(std::size_t r, const Eigen::VectorXd& residual) const;

  /// Mean squares (m^2) over the features of box and centre of a run.
  static Eigen::Array2d mean_squares(const FeaturePlan& plan, const Eigen::VectorXd& left);

  /// `measured`: allows for the emulator's own error, which values that it has made itself do not have.
  Objective objective_of(const std::vector<Eigen::VectorXd>& values, bool measured,
                         const std::vector<char>& used = {}) const;

  /// The rows of a run's residuals that the weights have not seen.
  auto unseen(std::size_t r) const {
    const Eigen::MatrixXd& all = emulators_[r].residuals;
    return all.bottomRows(all.rows() - all.rows() / 2);
  }

  /// Derivatives of the regression's terms, terms x knobs.
  Eigen::MatrixXd slopes_at(const Eigen::VectorXd& z) const;

  const std::vector<MeasuredFeatures>& measured_;
  const std::vector<Knob>& knobs_;
  std::vector<Emulator> emulators_;
  std::vector<Whitened> whitened_;
  Objective objective_;
};

}  // namespace shakedown
