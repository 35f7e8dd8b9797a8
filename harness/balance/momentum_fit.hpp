// SPDX-License-Identifier: MIT
// Solves the weighted regression of the weak momentum balance over several runs.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "force_shapes.hpp"
#include "measurement.hpp"
#include "weak_form.hpp"

namespace shakedown {

/// Holds a term with its columns ready: one ForceSamples a run.
struct PreparedTerm {
  std::string name;
  bool never_negative = false;
  std::vector<ForceSamples> samples;  ///< of each run
  const ForceShape* shape = nullptr;  ///< of a formula that no effect describes; nullptr: a known term
  ShapeValues shape_values{};
};

/// Holds the lower Cholesky factor of a covariance in which only neighbouring windows are dependent: n b^2
/// instead of n^3.
class BandFactor {
 public:
  /// Factors the covariance; the band reaches as far from its diagonal as it is not zero.
  explicit BandFactor(const Eigen::MatrixXd& covariance);
  Eigen::MatrixXd whiten(const Eigen::MatrixXd& values) const;  ///< L^-1 values
  double log_determinant() const;                               ///< of the covariance
  Eigen::VectorXd deviations() const;                           ///< square roots of the covariance's diagonal

 private:
  Eigen::Index band_ = 0;
  Eigen::MatrixXd rows_;  ///< row i holds L(i, i - band ... i)
};

/// Describes something of the camera or of what was weighed that is known to an error: always in the fit,
/// held by that.
struct BalanceNuisance {
  std::string name;                   ///< "camera.lens", "origin of L040"
  std::string unit;                   ///< of the deviation
  double deviation = 0;               ///< standard deviation beforehand
  std::vector<ForceSamples> samples;  ///< of each run, for unit strength; empty parts: not in that run
  double already = 0;                 ///< value of it that the runs were read with
};

/// Holds all runs' impulses with their noise covariance, whitened. Below them stand one row for the packed
/// layer, which tells a wrong mass from a wrong scale of x_com - x_box, one for the spring where something is
/// known of it, and one for each nuisance: what is known of it.
class MomentumProblem {
 public:
  /// The runs must outlive the problem. `window`, `hop`: s. Runs without frames, or of fewer than four
  /// windows, take no part.
  MomentumProblem(const std::vector<MomentumRun>& runs, double window, double hop);

  /// Sets the row of the packed layer: the slope that was measured, and `gain`, twice the slope that the
  /// runs' setups make of it (MomentumRun::plateau_gain). A slope that is no number leaves the row empty.
  void set_plateau(const PlateauSlope& plateau, double gain);
  /// Sets what is known beforehand of the spring's stiffness, relative to the runs'; error 0: nothing.
  void set_spring(double change, double error);
  /// Sets the nuisances; each gets a column and a row of its own.
  void set_nuisances(std::vector<BalanceNuisance> nuisances);
  const std::vector<BalanceNuisance>& nuisances() const { return nuisances_; }
  /// Returns one column a nuisance, by its standard deviation: size() x nuisances.
  const Eigen::MatrixXd& nuisance_columns() const { return nuisance_columns_; }
  /// Sets the wander of the tracks, from the next set_covariance() on.
  void set_wander(const Wander& wander) { wander_ = wander; }
  const Wander& wander() const { return wander_; }
  /// Returns how many windows all runs have together.
  Eigen::Index windows() const;
  double longest() const;  ///< s, from the first window of a run to its last

  std::size_t runs() const { return forms_.size(); }  ///< number of runs
  /// Return the weak form and the name of a run, from 0.
  const WeakForm& form(std::size_t run) const { return forms_[run]; }
  const std::string& run_name(std::size_t run) const { return forms_[run].run().name; }
  /// Returns how many rows there are: windows, and below them what is known beforehand.
  Eigen::Index size() const { return impulse_.size(); }
  /// Returns the first row of a run; rows() returns how many it has.
  Eigen::Index begin(std::size_t run) const { return begin_[run]; }
  Eigen::Index rows(std::size_t run) const { return forms_[run].windows(); }

  /// Keeps only windows in which the box moves by more than `excursion`, m, to either side.
  void keep_moving(double excursion);
  /// Takes the noise that enters through these forces (one ForceSamples a run; empty: none) into the
  /// covariance.
  void set_covariance(const std::vector<ForceSamples>& fitted);

  /// Returns what is added to chi2 to make -2 ln likelihood, to compare fits whose noise differs. It is
  /// relative to the covariance without fitted forces.
  double noise_penalty() const;
  const Eigen::VectorXd& impulse() const { return impulse_; }              ///< whitened
  Eigen::VectorXd column(const std::vector<ForceSamples>& samples) const;  ///< whitened; one entry a run
  Eigen::VectorXd column(const PreparedTerm& term) const { return column(term.samples); }
  Eigen::MatrixXd harmonic(
      double frequency) const;  ///< whitened, two columns, acceleration of box and grains
  /// Whitens values of one run (windows x anything).
  Eigen::MatrixXd whiten(std::size_t run, const Eigen::MatrixXd& values) const {
    return factor_[run].whiten(values);
  }
  /// Returns the impulses as they are, N s.
  Eigen::VectorXd raw_impulse(std::size_t run) const { return forms_[run].impulse(); }
  Eigen::VectorXd raw_deviation(std::size_t run) const;  ///< N s, standard deviation of each impulse
  /// Returns one column of a force's samples (one entry a run) or, where these are null, two of a sine of
  /// unit acceleration at `frequency` (Hz); N s, not whitened.
  Eigen::MatrixXd raw_columns(std::size_t run, const std::vector<ForceSamples>* samples,
                              double frequency) const;

 private:
  std::vector<WeakForm> forms_;
  std::vector<std::size_t> source_;  ///< index of the run among those given
  std::vector<BandFactor> factor_;   ///< of each run's covariance
  std::vector<Eigen::Index> begin_;
  double log_determinant_at_start_ = 0;
  Eigen::VectorXd impulse_;
  Wander wander_;
  bool started_ = false;
  std::vector<BalanceNuisance> nuisances_;
  Eigen::MatrixXd nuisance_columns_;
  double spring_ = 0, spring_error_ = 0;  ///< relative, of the stiffness; error 0: not known
  double plateau_ = 0,
         plateau_error_ = 0;  ///< what the layer shows beyond the setup, per m; error 0: nothing

  /// Puts impulses and nuisances together anew.
  void restack();
};

/// Holds a least-squares fit of whitened impulses on whitened columns.
struct Regression {
  Eigen::VectorXd strength, error;
  Eigen::MatrixXd covariance;
  double chi2 = 0;
  double degrees = 0;
  Eigen::VectorXd residual;
};
/// Fits the impulse (rows) by the columns (rows x terms), both whitened. Degrees are rows less terms. Where
/// columns depend on each other the shortest strengths are taken.
Regression regress(const Eigen::VectorXd& impulse, const Eigen::MatrixXd& columns);

/// Says how much chi2 falls when one candidate joins the columns already chosen.
struct Gain {
  double gain = 0;  ///< fall of chi2; 0 when the sign is forbidden
  double strength = 0;
  double error = 0;
};
/// Returns the gain of a whitened candidate. `residual`: what the columns already chosen leave;
/// `orthonormal`: an orthonormal basis of these (orthonormal_basis()).
Gain gain_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& orthonormal,
             const Eigen::VectorXd& candidate, bool never_negative);

/// Returns the columns of an orthonormal basis of the span.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns);

}  // namespace shakedown
