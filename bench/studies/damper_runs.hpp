// SPDX-License-Identifier: MIT
// Runs the paper's damper in its five lengths, with what its statements ask of each run.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "engine.hpp"
#include "execution.hpp"
#include "observables.hpp"
#include "statistic.hpp"

namespace shakedown {

/// What a statement needs of one run beyond its observables. NaN where there is none.
struct RunReading {
  Observables seen;
  double friction = absent;  ///< N, mu M_tot of the third extremum (Eq. frictioncoeff)
  double friction_curve_r2 =
      absent;  ///< of x_box about that friction-damped oscillator, until the first peak below 10 mm
  double energy_line_r2 = absent;  ///< of sqrt(E)(t) about its linear fit, until then
  double energy_line_ratio =
      absent;  ///< rms of sqrt(E)(t) about that line over rms about the best exponential
  double energy_flat =
      absent;  ///< share of that time in which sqrt(E) falls slower than a fifth of its mean rate
  double leaving_speed_ratio =
      absent;  ///< speed of the grains' centre in free flight over the box's top speed before
  double leaving_phase =
      absent;  ///< |x_box| over release at the moment of the box's top speed: 0 is mid-stroke
  double swing_after_1s = absent;   ///< m, largest |x_box| from 1 s on
  double swing_after_20s = absent;  ///< m
};

struct DamperRuns {
  std::string engine;
  Setup setup;
  std::vector<RunReading> runs;
  Trajectory first;                                              ///< run 0 with its samples
  std::vector<double> mean_x_box, mean_x_com, mean_root_energy;  ///< m, m, sqrt(J), at the times of `first`
  double rms_of_one_run_box = 0,
         rms_of_one_run_centre = 0;  ///< m, of a run about the mean, over time and runs

  /// Return mean and spread of this number over all runs.
  Statistic over(double RunReading::*what) const;
  Statistic over(const std::function<double(const RunReading&)>& what) const;
};

/// Returns "L = 40 mm, hard".
std::string name_of(const DamperRuns& runs);

struct RunsWanted {
  int runs = 1;
  Execution execution{};
};

/// Simulates the runs. Throws Interrupted.
DamperRuns damper_runs(const Engine& engine, const Setup& setup, const RunsWanted& wanted);

}  // namespace shakedown
