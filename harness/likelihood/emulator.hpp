// SPDX-License-Identifier: MIT
// Learns how the features of an experiment depend on parameters of the model. Runs of the engine at scattered
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

/// Describes a parameter that may be varied. Runs are scattered over `centre` +- `width`; values stay in
/// [low, high].
struct Knob {
  /// Setup path, e.g. "restitution.grain_grain"; several joined by "&" move together, e.g. both coefficients
  /// of grain_friction.
  std::string key;
  double centre = 0, width = 0;
  double low = 0, high = 0;
  bool curved = true;  ///< the regression has a square of it, and products with the other curved ones
  /// What is known of it beforehand, as a normal distribution: mean and standard deviation. An error of 0
  /// says that nothing is known.
  double believed = 0, believed_error = 0;
  bool cubic = false;  ///< the regression has a cube of it too, where it is curved
  /// True where what it does is known as a column of the features (MeasuredFeatures::by_camera), as of a
  /// camera, which is arithmetic on the recording. Runs are not scattered over it, and its term is straight.
  bool exact = false;
  /// Value at which the effect of a strength is absent; infinite for a length. Where absent_key names a
  /// parameter of the setup, the effect is absent at that parameter's value, wherever a fit takes it.
  double absent = 0;
  std::string absent_key{};

  double at(double z) const;  ///< value at z (the scattered box: [-1, 1]), kept in bounds
  /// Returns the z of a value; 0 where the knob has no width.
  double z_of(double value) const { return width > 0 ? (value - centre) / width : 0; }
};

/// Holds one measured run with what is needed to compare it. Runs of equal setup share their simulations.
struct MeasuredFeatures {
  std::string run;
  Setup setup;  ///< of this run, its duration cut to what is looked at
  FeaturePlan plan;
  Eigen::VectorXd values;  ///< m
  /// Change of the features by each exact parameter, m per unit, under the parameter's path.
  std::map<std::string, Eigen::VectorXd> by_camera{};
  /// Change of the features by one standard deviation of each unknown that this run has of its own (the
  /// trigger, the release), m: features x unknowns.
  Eigen::MatrixXd own{};
};

/// Returns the features of each run, with by_camera and own still empty. Throws InputError where no run has a
/// feature.
std::vector<MeasuredFeatures> features_of(const Measurement& measurement);

/// Returns this covariance of the features of a run (m^2) plus that of what the run has of its own.
Eigen::MatrixXd with_own(Eigen::MatrixXd covariance, const MeasuredFeatures& measured);

/// Holds the regression of one run's features on the knobs.
struct Emulator {
  Eigen::MatrixXd coefficients;  ///< terms x features
  Eigen::MatrixXd
      residuals;  ///< simulations x features, chaos from run to run, scaled to be unbiased in variance
  Eigen::MatrixXd terms;              ///< simulations x terms
  Eigen::MatrixXd inverse_normal;     ///< terms x terms, (X'X)^-1: error of a prediction
  std::vector<Eigen::Index> exact{};  ///< terms of exact knobs: not regressed, without error

  /// Returns the coefficients of the regression without every `blocks`-th simulation from number `block` on.
  Eigen::MatrixXd coefficients_without(Eigen::Index block, Eigen::Index blocks) const;
};

/// Returns the terms of the regression at z (one entry a knob): 1, z, then squares and products of the curved
/// ones, then cubes.
Eigen::VectorXd regression_terms(const std::vector<Knob>& knobs, const Eigen::VectorXd& z);
/// Returns how many terms these knobs have.
Eigen::Index number_of_terms(const std::vector<Knob>& knobs);

/// Sets every key of the knob to its centre.
void set_knob(Setup& setup, const Knob& knob, KnownEffects known);

/// Returns the setup with the knobs at z.
Setup setup_at(const Setup& setup, const std::vector<Knob>& knobs, const Eigen::VectorXd& z,
               KnownEffects known);

/// Returns one emulator for each measured run, from `count` new simulations of each different setup (more
/// where so many knobs have more terms), scattered over the knobs' box, and from those in the workshop's pool
/// that lie in it. Where no knob but exact ones has a width, all new simulations stand at the centre: the
/// mean and the chaos of one ensemble. Exact knobs may stand anywhere among the others; their terms stand in
/// the order of the knobs. `first_run` addresses the random numbers of the new simulations. Knobs that are
/// not curved are moved in the fraction `sparse` of the simulations only.
std::vector<Emulator> emulate(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                              int count, int first_run, const Workshop& workshop, double sparse = 1);

}  // namespace shakedown
