// SPDX-License-Identifier: MIT
// Describes how the features change with the strength of an effect, from simulations at a few strengths, and
// what the measured ones say of that strength. The change is no straight line from none: an effect that hides
// in refitted parameters does not follow one.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace shakedown {

/// Holds the change of all features of an experiment at one strength, whitened, with what refitted parameters
/// take up projected out.
struct SignatureLevel {
  double strength = 0;     ///< from the effect's absence, in its own unit; never 0
  Eigen::VectorXd change;  ///< mean with the effect less mean without
  double noise = 0;        ///< expected square of the change's error by the simulations with the effect
};

/// Holds what the model without the effect leaves of the measured features.
struct SignatureResidual {
  Eigen::VectorXd residual;  ///< measured less mean without the effect, as `change`
  double noise = 0;          ///< expected square of the error of that mean, which every change has too
};

/// Joins the levels to a curve that is nothing at strength zero. Where the strongest level is less than 16
/// times the weakest, or not all are positive, it is a polynomial: straight with one level, a parabola with
/// two or three, a cubic with more. Levels over a wider range are joined by straight lines, which go on
/// beyond the last: no polynomial follows what changes at its own scale in each decade.
class Signature {
 public:
  /// `exact`: the changes are arithmetic and share no error with the residual.
  Signature(const std::vector<SignatureLevel>& levels, const SignatureResidual& without, bool exact = false);

  /// Returns ln of the likelihood of the measured features at this strength over that of nothing. What is
  /// known of the change is b = D'r and a = |D|^2, the simulations' noise nu taken off both: b is normal
  /// about a where the effect is there and about 0 where it is not, with the variance a + nu, so that l = a
  /// (b - a / 2) / (a + nu). In the variance nu counts times the residual's squares per feature, where these
  /// are above 1.
  double log_likelihood(double strength) const;

  /// Returns the mean change at this strength, the noise of the simulations in it.
  Eigen::VectorXd change(double strength) const;

  /// Returns a / (a + nu) at this strength: the share of the log likelihood that is left by the simulations'
  /// noise.
  double share_seen(double strength) const;

 private:
  friend class PairSignature;

  /// Holds |D|^2 without noise, and the noise, at these weights.
  struct Squares {
    double square, noise;
  };
  /// Returns both at these weights of the shapes, neither below 0.
  Squares squares(const Eigen::VectorXd& weights) const;
  /// Returns the weights of the shapes at this strength.
  Eigen::VectorXd weights(double strength) const;

  std::vector<double> corners_{};   ///< strengths of the levels, ascending, where it is straight between them
  Eigen::Index order_ = 1;          ///< number of shapes
  double unit_ = 1;                 ///< strength of which powers are taken
  Eigen::MatrixXd shapes_;          ///< features x order
  Eigen::MatrixXd square_, noise_;  ///< order x order: of the shapes, and of their errors
  Eigen::VectorXd overlap_;         ///< with the residual
  Eigen::VectorXd shared_;          ///< the part of the error of nothing that each shape has
  double of_nothing_ = 0;           ///< expected square of that error
  double chi2_per_feature_ = 1;
};

/// Describes two effects at once: their changes add, as far as each is a line in the other (an assumption
/// that a fit is to confirm).
class PairSignature {
 public:
  /// Both must be of one screen, so that they share the features, the residual and its error, and outlive
  /// this.
  PairSignature(const Signature& first, const Signature& second);

  /// Like Signature::log_likelihood, with both effects present.
  double log_likelihood(double first, double second) const;

 private:
  const Signature *first_, *second_;
  Eigen::MatrixXd cross_, shared_;  ///< order x order: of the shapes, and of the error that both have
};

/// Says what is known of a strength beforehand and where it may lie.
struct StrengthPrior {
  double typical = 1;        ///< scale of a Cauchy distribution about none
  double low = 0, high = 0;  ///< strengths that are possible; the prior is normalised between them
};

/// Says what the features tell of a strength.
struct StrengthPosterior {
  double log_evidence = 0;  ///< ln of the likelihood averaged over the prior, over that of nothing
  double gain = 0;          ///< twice the largest ln likelihood, as a fall of chi2
  double strength = 0;      ///< where that is
  double error = 0;         ///< standard deviation of the strength, the likelihood alone counted
  double share_seen = 1;    ///< of the gain, that the simulations' noise leaves there
};

/// Sums over 2000 quantiles of the prior. log_evidence is NaN where a likelihood is not finite.
StrengthPosterior posterior_of(const Signature& signature, const StrengthPrior& prior);

/// Says what the features tell of two strengths.
struct PairPosterior {
  double log_evidence = 0;       ///< ln of the likelihood averaged over both priors, over that of nothing
  double first = 0, second = 0;  ///< strengths where the likelihood is largest
};

/// Sums over 100 x 100 quantiles of the priors. Where a peak is narrower than a step of these ln evidence is
/// too small by up to 1 %: seen 1079 to 1086 for 1093.
PairPosterior posterior_of(const Signature& first, const StrengthPrior& of_first, const Signature& second,
                           const StrengthPrior& of_second);

}  // namespace shakedown
