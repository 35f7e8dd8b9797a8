// SPDX-License-Identifier: MIT
// Builds the linear regression that ranks effects, whatever the weights: measured less modelled, and what
// each knob does to it.
#pragma once
#include <functional>
#include <vector>

#include "candidates.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Holds all measured runs, stacked.
struct LinearModel {
  Eigen::MatrixXd columns;   ///< features x knobs, by one width of each knob
  Eigen::VectorXd residual;  ///< measured less the model at the knobs' centres
};

/// Weighs a block of run `r`: features x anything, in place.
using Weigh = std::function<void(std::size_t r, Eigen::MatrixXd& block)>;

/// Returns the linear terms of the emulators, one of each measured run, for so many knobs. No `weigh`:
/// metres.
LinearModel linear_model(const std::vector<MeasuredFeatures>& measured,
                         const std::vector<Emulator>& emulators, std::size_t knobs, const Weigh& weigh = {});

/// Holds the fitted parameters and some candidates, to be scattered together.
struct BesideFitted {
  std::vector<Knob> knobs;                 ///< the fitted ones, then the candidates', all straight
  std::vector<std::size_t> candidate_of;   ///< of each knob after the fitted ones
  std::vector<MeasuredFeatures> measured;  ///< with what the candidates need besides
};
/// Returns the fitted parameters beside the candidates of these indices (`members`).
BesideFitted beside_fitted(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                           const std::vector<Candidate>& candidates, const std::vector<std::size_t>& members,
                           KnownEffects known);

/// Sets kicks 40 ms apart; fits need them more often. Drag on grains comes in kicks that cost most: at 60 ms
/// the slope of the decay differs by less than its error over 128 runs, 0.004 mm/s of 8.4, of which drag of 3
/// mN s/m makes 0.23.
std::vector<MeasuredFeatures> kicked_rarely(std::vector<MeasuredFeatures> measured);

/// Returns the residual of the model in which every knob from the number `fitted` on is at its absence.
Eigen::VectorXd residual_without(const LinearModel& model, const std::vector<Knob>& knobs,
                                 std::size_t fitted);

/// Returns the knobs with no curvature, `widths` times as wide.
std::vector<Knob> straight(std::vector<Knob> knobs, double widths);

}  // namespace shakedown
