// SPDX-License-Identifier: MIT
// How the features of an experiment depend on parameters of the model. Runs of the engine at scattered
// parameter values (each its own microstate) are regressed on those values: every run tells of every
// parameter at once, and what is left over is the chaos from run to run. A regression replaces hundreds of
// ensembles on a grid.
#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "features.hpp"
#include "known_effects.hpp"
#include "workshop.hpp"

namespace shakedown {

/// A parameter that may be varied. `centre` +- `width` is where runs are scattered; values stay in [low,
/// high].
struct Knob {
  /// Setup path, e.g. "restitution.grain_grain"; several joined by "&" move together, e.g. both coefficients
  /// of grain_friction.
  std::string key;
  double centre = 0, width = 0;
  double low = 0, high = 0;
  bool curved = true;  ///< the regression has a square of it, and products with the other curved ones
  /// What is known of it beforehand: a normal distribution of this mean and standard deviation; 0: nothing
  /// is.
  double believed = 0, believed_error = 0;
  bool cubic = false;  ///< ... and a cube (with curved)
  /// Of the camera: what it does is arithmetic on the recording (MeasuredFeatures::by_camera), so runs are
  /// not scattered over it. Straight.
  bool exact = false;
  /// Of an effect's strength: the value at which the effect is absent; infinite of a length. With a key of
  /// the setup here that is the value of that parameter, wherever a fit takes it.
  double absent = 0;
  std::string absent_key{};

  double at(double z) const;  ///< value at z in [-1, 1], kept in bounds
  double z_of(double value) const { return width > 0 ? (value - centre) / width : 0; }
};

/// The measured runs with what is needed to compare them; runs of equal setup share their simulations.
struct MeasuredFeatures {
  std::string run;
  Setup setup;  ///< of this run, its duration cut to what is looked at
  FeaturePlan plan;
  Eigen::VectorXd values;  ///< m
  /// Change of the features by a parameter of the camera, m per unit: by the parameter's path.
  std::map<std::string, Eigen::VectorXd> by_camera{};
  /// What each run has of its own and nobody knows (the trigger), features x such things, each by its
  /// standard deviation, m.
  Eigen::MatrixXd own{};
};

/// Of each run, without what a camera does to it.
std::vector<MeasuredFeatures> features_of(const Measurement& measurement);

/// A covariance of its features with what the run has of its own.
Eigen::MatrixXd with_own(Eigen::MatrixXd covariance, const MeasuredFeatures& measured);

/// Regression of one run's features on the knobs.
struct Emulator {
  Eigen::MatrixXd coefficients;  ///< terms x features
  Eigen::MatrixXd
      residuals;  ///< simulations x features, chaos from run to run, scaled to be unbiased in variance
  Eigen::MatrixXd terms;              ///< simulations x terms
  Eigen::MatrixXd inverse_normal;     ///< terms x terms, (X'X)^-1: error of a prediction
  std::vector<Eigen::Index> exact{};  ///< terms of exact knobs: not regressed, without error

  /// The coefficients without every `blocks`-th simulation from `block` on.
  Eigen::MatrixXd coefficients_without(Eigen::Index block, Eigen::Index blocks) const;
};

/// Terms of the regression at z (one entry a knob): 1, z, then squares and products of the curved ones, then
/// cubes.
Eigen::VectorXd regression_terms(const std::vector<Knob>& knobs, const Eigen::VectorXd& z);

/// Sets every key of the knob to its centre.
void set_knob(Setup& setup, const Knob& knob, KnownEffects known);

/// The setup with the knobs at z.
Setup setup_at(const Setup& setup, const std::vector<Knob>& knobs, const Eigen::VectorXd& z,
               KnownEffects known);

/// One emulator for each measured run from `count` simulations (of each different setup) scattered over the
/// knobs' box, and those in the workshop's pool that lie in it; knobs of no width: all at the centre, the
/// mean and the chaos of one ensemble. Exact knobs may stand anywhere among the others; their terms stand in
/// the order of the knobs. first_run addresses the random numbers of the new ones. A knob with
/// `sparse` < 1 is moved in that fraction of the simulations only.
std::vector<Emulator> emulate(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                              int count, int first_run, const Workshop& workshop, double sparse = 1);

}  // namespace shakedown
