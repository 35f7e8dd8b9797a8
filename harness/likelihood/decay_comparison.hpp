// SPDX-License-Identifier: MIT
// Compares measured runs with a model by what a person asks first: frequency, slope of the decay and the
// first peaks; for a forced run its steady state; and what the layer of grains does when it lands.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator.hpp"

namespace shakedown {

/// Holds a number of a measured run beside the same of the model's runs: their mean and standard deviation
/// from run to run.
struct MeasuredNumber {
  double measured = 0, model = 0, spread = 0;  ///< NaN where there is no such number
};

/// Compares a forced run over its last cycles (SteadyState).
struct ForcedComparison {
  MeasuredNumber amplitude, phase_lag, loss_factor, effective_mass;  ///< m, rad, -, kg
};

/// Says how one number of a ForcedComparison is told: `number` times `scale` is in `unit`.
struct ForcedRow {
  const char *key, *label, *unit;  ///< "amplitude_mm", "amplitude", "mm"
  double scale;
  int digits;  ///< behind the point
  MeasuredNumber number;
};
/// Returns the rows of the numbers that were measured.
std::vector<ForcedRow> rows_of(const ForcedComparison& forced);
/// Returns "amplitude 27.6 (27.3 +- 0.9) mm, lag ...": measured (model +- spread from run to run).
std::string told(const ForcedComparison& forced);

/// Compares a landing of the layer on an end wall (landings.hpp) with those of the model at that time. The
/// spread is from run to run and from the noise of the camera.
struct LandingComparison {
  double time = 0;                                              ///< s
  MeasuredNumber speed, momentum, rebound, lasting, thickness;  ///< m/s, kg m/s, -, s, m
};

/// Says how one number of the landings is told: times `scale` it is in `unit`.
struct LandingRow {
  const char *key, *name, *label, *unit;  ///< "thickness_mm", "thickness of the layer", "layer", "mm"
  double scale;
  int digits;  ///< behind the point
  MeasuredNumber LandingComparison::*number;
};
/// Returns the rows of all numbers of a landing, in the order in which they are told.
std::span<const LandingRow> landing_rows();

/// Returns the mean of one number over the landings where data and model both have it, with the mean's spread
/// from run to run as if landings scattered by themselves; NaN where there are none.
MeasuredNumber mean_of(const std::vector<LandingComparison>& landings, const LandingRow& row);
/// Returns "8 landings, mean: given to the wall 142.1 (139.0 +- 2.1) mN s, ..."; empty without landings.
std::string told(const std::vector<LandingComparison>& landings);

/// Compares one measured run with the model's runs.
struct DecayComparison {
  std::string run;
  MeasuredNumber frequency;           ///< Hz, of the first ten zero crossings
  MeasuredNumber slope;               ///< m/s, of |peaks| until they are small (observables.hpp)
  std::vector<MeasuredNumber> peaks;  ///< m, signed: the first ones
  std::string why_not;                ///< why there are no peaks; empty where there are
  std::optional<ForcedComparison> forced{};
  std::vector<LandingComparison> landings{};  ///< the first ones of a run that is not forced
};

/// Compares each measured run with `runs` simulations of its own, numbered from first_run, in as many `peaks`
/// at most. Simulated motion is read at the very frames of the measured one and by the same fits, so that a
/// slow camera tells on both alike. Throws Interrupted.
std::vector<DecayComparison> compare_decay(const Measurement& measurement, const Workshop& workshop, int runs,
                                           int first_run, int peaks = 4);

}  // namespace shakedown
