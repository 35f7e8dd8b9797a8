// SPDX-License-Identifier: MIT
// Fits parameters of a model to some runs of an experiment, with intervals, and tells how well the model then
// foretells the runs left out.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact_curve.hpp"
#include "execution.hpp"
#include "known_effects.hpp"
#include "nuisance_found.hpp"
#include "refit_result.hpp"
#include "slow_wander.hpp"

namespace shakedown {

/// Says which runs are fitted, and how.
struct FitOptions {
  std::vector<std::string> on;  ///< names of the runs to fit; empty: all
  int count = 160;              ///< simulations of each different setup in a round
  Execution execution{};
  Wander wander{};         ///< of the tracks
  int first_run = 500000;  ///< addresses the random numbers of the simulations
  KnownEffects known;
  /// Is told the stage in words and the number of simulations so far; may be empty.
  std::function<void(const std::string& stage, std::int64_t runs)> progress{};
};

/// Holds one fitted parameter as a user is told of it.
struct FittedParameter {
  std::string key, unit;
  double start = 0, value = 0, low = 0, high = 0;  ///< SI; 95 % interval
  double error = 0;                                ///< standard error, SI
  bool told = true;                                ///< false: the data do not tell it
  std::string remark;                              ///< why not, or with what it is confounded
};

/// Says what a fit with a constant in place of each curve leaves, everything else as free.
struct ConstantBeside {
  double p_value = 1, scatter = 1;       ///< as of the fit
  Standing standing = Standing::holds;   ///< of the constant, by the runs used
  Standing of_curves = Standing::holds;  ///< of the curves, by the same
};

/// Holds what a fit found, and how well it foretells the runs left out.
struct Fit {
  std::vector<FittedParameter> parameters;
  std::vector<NuisanceFound> beside{};     ///< camera and weights, which were free beside
  Eigen::MatrixXd correlation;             ///< of the estimates
  std::vector<RunComparison> used;         ///< runs fitted, at the solution
  std::vector<RunComparison> left_out;     ///< the others, foretold
  std::vector<MeasuredFeatures> measured;  ///< what was fitted to, of the runs used
  Refit solution;                          ///< its last round
  double p_value = 1;  ///< share of the model's own runs that fit no better than the runs used; NaN: an empty
                       ///< box has no such runs
  double scatter = 1;  ///< misfit over that of the model's own runs
  /// Judges the fitted model, by the runs used alone where nobody has asked the momentum balance too.
  ModelJudgement judgement;
  Setup start;  ///< from which it began, with the curves that were asked for
  Setup fitted;
  std::vector<ContactCurve> curves{};        ///< where restitution or friction was a free function of a speed
  std::optional<ConstantBeside> constant{};  ///< of a fit with curves
  std::int64_t runs = 0;                     ///< simulated
  double seconds = 0;
};

/// Fits the knobs of the setup, which is the measurement's too, from where they start: first to the beginning
/// of the runs, where a wrong frequency has not yet turned the phase round, then to more and more of them.
/// Throws InputError for runs that the experiment does not have and for fewer simulations than the knobs
/// need, Interrupted.
Fit fit_parameters(const Setup& setup, const Measurement& measurement, std::vector<Knob> knobs,
                   const Engine& engine, const FitOptions& options);

/// Throws InputError for names that no run of the experiment has.
void refuse_unknown_runs(const Measurement& measurement, const std::vector<std::string>& names);

/// Returns the values of a fit that fit_parameters() has not made, each with what is to be said of it.
/// `start`: its knobs, in the order of its values.
std::vector<FittedParameter> parameters_of(const Refit& fit, const std::vector<Knob>& start,
                                           KnownEffects known);

/// Returns the correlation matrix of this covariance.
Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance);

/// Returns the parameters of the fit as a Refit has them, SI.
std::vector<FittedValue> values_of(const Fit& fit);

/// Returns the coefficient against its speed with its band, by the parameters of the fit.
ContactCurve curve_of(const CurveLaw& law, const Fit& fit, KnownEffects known);

/// Says in words whether the measurements tell that what has a curve depends on the speed; where a constant
/// holds they do not. Empty without a curve.
std::string words_of_constant(const Fit& fit);

/// Return the whole fit as JSON text and as text for a terminal.
std::string fit_json(const Fit& fit);
std::string fit_text(const Fit& fit);

}  // namespace shakedown
