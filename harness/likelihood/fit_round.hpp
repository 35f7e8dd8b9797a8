// SPDX-License-Identifier: MIT
// Answers what one round of a fit asks: what a batch of scattered simulations tells of the measured runs.
#pragma once
#include <Eigen/Cholesky>
#include <vector>

#include "objective.hpp"
#include "random.hpp"
#include "refit_options.hpp"

namespace shakedown {

/// How far from the middle of the scattered box (which ends at 1) a solution may lie before the box follows.
constexpr double reach = 1.5;

/// Holds one measured run, whitened.
struct Whitened {
  Eigen::LLT<Eigen::MatrixXd> root;  ///< L of the covariance of the run's features, m
  Eigen::MatrixXd model;             ///< L^-1 times the emulator's coefficients, features x terms
  Eigen::VectorXd spread;            ///< m, standard deviation of each feature
  double chaos =
      0;  ///< mean square of a simulation's whitened chaos, from simulations that the covariance has not seen
  double expected = 0;    ///< of the whitened sum of squares: chaos, camera noise, the run's own
  Eigen::MatrixXd own{};  ///< covariance^-1 times MeasuredFeatures::own
  double codes = 0;       ///< m^2, variance of what two codes of one physics differ by
};

/// Holds what recordings that the model itself makes leave when the model is fitted to them.
struct PseudoExperiments {
  std::vector<double> sums;              ///< chi2 of each
  Eigen::MatrixXd cell_rows;             ///< experiments x cells (failure_cells.hpp)
  std::vector<Eigen::ArrayX2d> squares;  ///< m^2, of each run: experiments x (box, centre), mean squares
};

/// Holds the covariance that judges a run's residual.
struct JudgingRule {
  Eigen::LLT<Eigen::MatrixXd> root;
  double expected = 0;  ///< of the whitened sum of squares, by the round that judges
};

/// Holds one batch of simulations of all measured runs, ready to be fitted and judged.
class FitRound {
 public:
  /// `measured` and `knobs` must outlive it. The first half of each emulator's simulations gives the weights.
  FitRound(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
           std::vector<Emulator> emulators, const RefitOptions& options);

  const Objective& objective() const { return objective_; }  ///< what is minimised over the knobs
  const std::vector<Knob>& knobs() const { return knobs_; }  ///< that are fitted, as handed over

  /// Returns linear emulators about z, from simulations made there (`there`: regressions on nothing) and the
  /// slopes of this round, by one width of each knob.
  std::vector<Emulator> recentred(const Eigen::VectorXd& z, std::vector<Emulator> there) const;
  /// Returns these emulators, which are straight, about z instead of where they stand.
  std::vector<Emulator> moved_to(const Eigen::VectorXd& z) const;
  /// Returns the features of run r that the emulator makes at z, m (z in widths of the knobs).
  Eigen::VectorXd model(std::size_t r, const Eigen::VectorXd& z) const;

  /// Fits pseudo-experiments (the model at z, a simulation that the covariance has not seen for each run,
  /// camera noise and what the run has of its own) and fills in what they say of `observed`, a chi2:
  /// p-values, scatter, degrees and cells of `result`, and floors and chances of its runs, which comparison()
  /// has made.
  void calibrate(const Eigen::VectorXd& z, double observed, Refit& result) const;

  /// Predicts each box length from a fit to the others, with the same simulations, and fills in what that
  /// leaves; NaN with one length only. `rules`: of each run.
  void hold_out(Refit& result, const std::vector<JudgingRule>& rules) const;

  /// Returns the covariance of the fitted z, the sandwich A^-1 B A^-1. A: the sensitivities' square less what
  /// the emulator's error adds to it (second derivatives times residuals are mostly noise of the emulator).
  /// B: what chaos that the weights have not seen, camera noise and the emulator's error make of the
  /// gradient; weights that are far from the best make B larger than A. A direction that the data leave open
  /// gets the size of the searched box, `open`.
  Eigen::MatrixXd covariance_at(const Eigen::VectorXd& z, double open) const;

  /// Returns the covariance of the fitted z from the emulators' own noise, by the jackknife: what simulations
  /// left out do to the minimum near z. To first order covariance_at() has it; along a valley, where noise
  /// makes the slope, it is more.
  Eigen::MatrixXd emulator_scatter(const Eigen::VectorXd& z) const;

  /// Returns the chi2 of run r at z by this rule, which may be another fit's, less what the emulator's own
  /// error adds to its expectation. What the knobs' values cost beforehand (Objective::disbelief()) is not in
  /// it.
  double judged_chi2(std::size_t r, const Eigen::VectorXd& z, const JudgingRule& rule) const;

  /// Returns a rule for each run: with the covariances of `other`, or of this round where there is none.
  std::vector<JudgingRule> rules_of(const Refit* other) const;

  /// Returns the covariance of each run's features, m^2.
  std::vector<Eigen::MatrixXd> covariances() const;
  /// Returns covariance_for_means() of all simulations of each run, with what the run has of its own, m^2.
  /// `model_error`: in parts of the release displacement.
  std::vector<Eigen::MatrixXd> for_means(double model_error) const;

  /// Compares run r with the model at z (in widths of the knobs).
  RunComparison comparison(std::size_t r, const Eigen::VectorXd& z) const;

  /// Returns the errors of box and centre of a run and what they are uncertain by. `run`: comparison() of run
  /// r; `covariance`: of z, as covariance_at() has it.
  std::vector<Validation> validation(const RunComparison& run, std::size_t r, const Eigen::VectorXd& z,
                                     const Eigen::MatrixXd& covariance) const;

 private:
  /// Returns the whitened sum of squares to be expected of run r: chaos that the covariance has not seen,
  /// camera noise, what is the run's own. `root`: of the covariance.
  double expected_sum(std::size_t r, const Eigen::LLT<Eigen::MatrixXd>& root) const;
  /// Returns the measured features of each run, m.
  std::vector<Eigen::VectorXd> measured_values() const;

  /// Returns the standard deviations of each run's features, m.
  std::vector<Eigen::VectorXd> spreads() const;

  /// Returns features of run r that the model at z makes: a simulation that the covariance has not seen,
  /// filmed.
  Eigen::VectorXd drawn(std::size_t r, const Eigen::VectorXd& z, Random& random) const;
  /// Makes recordings as the model at z makes them, fits the model to each and keeps what that leaves.
  PseudoExperiments made_by_the_model(const Eigen::VectorXd& z, const std::vector<Cell>& cells) const;
  /// Sets the floors and chances of a run from the mean squares (m^2) of box and centre that
  /// pseudo-experiments leave.
  void set_floors(std::size_t r, const Eigen::VectorXd& z, const Eigen::ArrayX2d& squares,
                  RunComparison& run) const;

  /// Returns a residual (m) less what the run has of its own (release, clock, an origin that nobody stated,
  /// the track's wander), as far as the run itself tells it.
  Eigen::VectorXd without_own(std::size_t r, const Eigen::VectorXd& residual) const;

  /// Returns the mean squares (m^2) over the features of box and centre of a run.
  static Eigen::Array2d mean_squares(const FeaturePlan& plan, const Eigen::VectorXd& left);

  /// Returns the objective of these values (m), of all runs or of those flagged in `used`. `measured`: allows
  /// for the emulator's own error, which values that it has made itself do not have.
  Objective objective_of(const std::vector<Eigen::VectorXd>& values, bool measured,
                         const std::vector<char>& used = {}) const;

  /// Returns the rows of a run's residuals that the weights have not seen.
  auto unseen(std::size_t r) const {
    const Eigen::MatrixXd& all = emulators_[r].residuals;
    return all.bottomRows(all.rows() - all.rows() / 2);
  }

  /// Returns the derivatives of the regression's terms at z, terms x knobs.
  Eigen::MatrixXd slopes_at(const Eigen::VectorXd& z) const;

  const std::vector<MeasuredFeatures>& measured_;
  const std::vector<Knob>& knobs_;
  std::vector<Emulator> emulators_;
  std::vector<Whitened> whitened_;
  Objective objective_;
};

}  // namespace shakedown
