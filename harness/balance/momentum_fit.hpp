// SPDX-License-Identifier: MIT
// Weighted regression of the weak momentum balance over several runs, and forward selection of its terms.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "force_shapes.hpp"
#include "weak_form.hpp"

namespace shakedown {

/// A term with its columns ready: one ForceSamples a run.
struct PreparedTerm {
  std::string name;
  bool never_negative = false;
  std::vector<ForceSamples> samples;  ///< of each run
  const ForceShape* shape = nullptr;  ///< of a formula that no effect describes; nullptr: a known term
  ShapeValues shape_values{};
};

/// Lower Cholesky factor of a covariance in which only neighbouring windows are dependent: n b^2 instead of
/// n^3.
class BandFactor {
 public:
  /// `covariance` with everything further than `band` off the diagonal equal to zero.
  explicit BandFactor(const Eigen::MatrixXd& covariance);
  Eigen::MatrixXd whiten(const Eigen::MatrixXd& values) const;  ///< L^-1 values
  double log_determinant() const;                               ///< of the covariance
  Eigen::VectorXd deviations() const;                           ///< square roots of the covariance's diagonal

 private:
  Eigen::Index band_ = 0;
  Eigen::MatrixXd rows_;  ///< row i holds L(i, i - band ... i)
};

/// All runs' impulses with their noise covariance, whitened.
class MomentumProblem {
 public:
  /// The runs must outlive the problem. Runs without frames take no part.
  MomentumProblem(const std::vector<MomentumRun>& runs, double window, double hop);

  std::size_t runs() const { return forms_.size(); }
  const WeakForm& form(std::size_t run) const { return forms_[run]; }
  const std::string& run_name(std::size_t run) const { return forms_[run].run().name; }
  Eigen::Index size() const { return impulse_.size(); }
  /// First row and number of rows of a run.
  Eigen::Index begin(std::size_t run) const { return begin_[run]; }
  Eigen::Index rows(std::size_t run) const { return forms_[run].windows(); }

  /// Keeps only windows in which the box moves by more than `excursion`, m, to either side.
  void keep_moving(double excursion);
  /// Takes the noise that enters through these forces (one ForceSamples a run; empty: none) into the
  /// covariance.
  void set_covariance(const std::vector<ForceSamples>& fitted);

  /// -2 ln likelihood is chi2 plus this: to compare fits whose noise differs. Relative to the covariance
  /// without fitted forces.
  double noise_penalty() const;
  const Eigen::VectorXd& impulse() const { return impulse_; }  ///< whitened
  Eigen::VectorXd column(const PreparedTerm& term) const;      ///< whitened
  Eigen::MatrixXd harmonic(
      double frequency) const;  ///< whitened, two columns, acceleration of box and grains
  Eigen::MatrixXd whiten(std::size_t run, const Eigen::MatrixXd& values) const {
    return factor_[run].whiten(values);
  }
  /// The impulses as they are, N s.
  Eigen::VectorXd raw_impulse(std::size_t run) const { return forms_[run].impulse(); }
  Eigen::VectorXd raw_deviation(std::size_t run) const;  ///< N s, standard deviation of each impulse

 private:
  std::vector<WeakForm> forms_;
  std::vector<std::size_t> source_;  ///< index of the run among those given
  std::vector<BandFactor> factor_;   ///< of each run's covariance
  std::vector<Eigen::Index> begin_;
  double log_determinant_at_start_ = 0;
  Eigen::VectorXd impulse_;

  void restack();
};

/// Least squares of whitened impulses on whitened columns.
struct Regression {
  Eigen::VectorXd strength, error;
  Eigen::MatrixXd covariance;
  double chi2 = 0;
  double degrees = 0;
  Eigen::VectorXd residual;
  double p_value() const;
};
Regression regress(const Eigen::VectorXd& impulse, const Eigen::MatrixXd& columns);

/// How much chi2 falls when one candidate joins the columns already chosen.
struct Gain {
  double gain = 0;  ///< fall of chi2; 0 when the sign is forbidden
  double strength = 0;
  double error = 0;
};
Gain gain_of(const Eigen::VectorXd& residual, const Eigen::MatrixXd& orthonormal,
             const Eigen::VectorXd& candidate, bool never_negative);

/// Columns of an orthonormal basis of the span.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns);

}  // namespace shakedown
