// SPDX-License-Identifier: MIT
// What a person asks first of a measured run beside a model: frequency, slope of the decay and the first
// peaks; of a forced one its steady state; what the layer of grains does when it lands.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "emulator.hpp"

namespace shakedown {

/// A number of a measured run, and the same of the model's runs: mean and standard deviation from run to run.
struct MeasuredNumber {
  double measured = 0, model = 0, spread = 0;  ///< NaN where there is no such number
};

/// Over the last cycles of a forced run (SteadyState).
struct ForcedComparison {
  MeasuredNumber amplitude, phase_lag, loss_factor, effective_mass;  ///< m, rad, -, kg
};

/// One of its numbers, as it is told: `number` times `scale` is in `unit`.
struct ForcedRow {
  const char *key, *label, *unit;  ///< "amplitude_mm", "amplitude", "mm"
  double scale;
  int digits;  ///< behind the point
  MeasuredNumber number;
};
/// Those that were measured.
std::vector<ForcedRow> rows_of(const ForcedComparison& forced);
/// "amplitude 27.6 (27.3 +- 0.9) mm, lag ...": measured (model +- spread from run to run).
std::string told(const ForcedComparison& forced);

/// A landing of the layer on an end wall (landings.hpp), beside those of the model at that time; the spread
/// is from run to run and of the camera's noise.
struct LandingComparison {
  double time = 0;                                              ///< s
  MeasuredNumber speed, momentum, rebound, lasting, thickness;  ///< m/s, kg m/s, -, s, m
};

/// One number of the landings, as it is told: times `scale` it is in `unit`.
struct LandingRow {
  const char *key, *name, *label, *unit;  ///< "thickness_mm", "thickness of the layer", "layer", "mm"
  double scale;
  int digits;  ///< behind the point
  MeasuredNumber LandingComparison::*number;
};
std::span<const LandingRow> landing_rows();

/// Mean of one number over the landings where data and model both have it, and its spread from run to run if
/// landings scatter by themselves; NaN where there are none.
MeasuredNumber mean_of(const std::vector<LandingComparison>& landings, const LandingRow& row);
/// "8 landings, mean: given to the wall 142.1 (139.0 +- 2.1) mN s, ..."; empty without landings.
std::string told(const std::vector<LandingComparison>& landings);

struct DecayComparison {
  std::string run;
  MeasuredNumber frequency;           ///< Hz, of the first ten zero crossings
  MeasuredNumber slope;               ///< m/s, of |peaks| until they are small (observables.hpp)
  std::vector<MeasuredNumber> peaks;  ///< m, signed: the first ones
  std::string why_not;                ///< why there are no peaks; empty where there are
  std::optional<ForcedComparison> forced{};
  std::vector<LandingComparison> landings{};  ///< the first ones of a run that is not forced
};

/// Simulated motion is read at the very frames of the measured one and by the same fits, so that a slow
/// camera tells on both alike. `runs` simulations for each measured run, numbered from first_run.
std::vector<DecayComparison> compare_decay(const Measurement& measurement, const Workshop& workshop, int runs,
                                           int first_run, int peaks = 4);

}  // namespace shakedown
