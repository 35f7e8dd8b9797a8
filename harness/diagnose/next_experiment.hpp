// SPDX-License-Identifier: MIT
// Finds which experiment would tell two suspects apart. Both models, as fitted to what was measured, are
// simulated in other box lengths, numbers of grains and releases; what counts is how far apart their motions
// lie beside camera noise, chaos, and what is left open in the parameters.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "emulator.hpp"
#include "refit_result.hpp"

namespace shakedown {

/// Describes an experiment.
struct Design {
  int grains = 0;
  double length = 0, release = 0;  ///< m
  std::string words() const;       ///< "N = 59, L = 65 mm, release 107.5 mm"
};

/// Returns designs that need no other apparatus, without those that were measured: there both models were
/// fitted.
std::vector<Design> possible_designs(const Setup& setup, const std::vector<MeasuredFeatures>& measured);

/// Returns the setup as this experiment would have it.
Setup in_design(Setup setup, const Design& design);

/// Holds a model as fitted.
struct FittedModel {
  Setup setup;                 ///< with the fitted values
  std::vector<Knob> knobs;     ///< what was fitted, centred at the fitted values
  Eigen::MatrixXd covariance;  ///< of these, in their units
};
/// Returns `setup` as fitted, with knobs and covariance of the fit but for exact knobs: a new experiment has
/// a camera of its own.
FittedModel fitted_model(Setup setup, const Refit& fit);

/// Says what one design would tell.
struct Advice {
  std::string words;
  double sigmas = 0;  ///< by which one run of the design tells the one model from the other
};

/// Says how a design is looked at.
struct AdviceTrial {
  double noise_box = 0, noise_centre = 0;  ///< of a frame, m
  int count = 0;                           ///< simulations of each model in each design
  int first_run = 0;                       ///< number of their microstates
};

/// Returns one entry a design, best first; designs whose grains do not fit into the box are left out. It is
/// linear in what is open in the parameters of `found`. The simulations' noise is allowed for: what is told
/// by less than about one sigma reads 0.
std::vector<Advice> advise(const std::vector<Design>& designs, const FittedModel& found, const Setup& rival,
                           const AdviceTrial& trial, const Workshop& workshop);

}  // namespace shakedown
