// SPDX-License-Identifier: MIT
// Measures how strong the trace of a hidden effect is for a judge who knows its form, the spread from run to
// run and the camera: what no diagnosis can exceed. It takes simulations alone, no diagnosis and none of its
// likelihoods.
#pragma once
#include "trial.hpp"

namespace shakedown {

/// Says what the judge does not know, as standard deviations. Frequency and scale: relative. Clock and origin
/// are of each run.
struct IdealIgnorance {
  double restitution = 0.1, frequency = 0.01, scale = 0.005;
  double clock = 2e-3;   ///< s
  double origin = 1e-3;  ///< m
};

/// Says what is filmed and how much is simulated.
struct IdealSettings {
  std::vector<PlannedRun> runs{};
  /// Its lens, shutter, depth, wander and release are as unknown to the judge as they are large.
  RecordingSettings recording{};
  IdealIgnorance ignorance{};
  int count = 24;  ///< simulations of each different run and half
  std::uint64_t seed = 1;
};

/// Returns the distance sqrt(s'C^-1 s) of `with` from `without` in standard deviations: s is the mean
/// difference of the positions of box and grains in bins of 0.1 s, C the spread from run to run, the camera's
/// noise and what the judge does not know. Two halves of the simulations keep the noise of s out of it. Its
/// square is uncertain by about sqrt(bins of all runs) 2/count, some 3 with five runs of 12 s; it is given a
/// minus where its square comes out below zero (nothing to see). A spread known from few simulations costs
/// some of it: 3.7 with 16 and 5.0 with 48 for side walls of restitution 0.3 in the paper's damper. Throws
/// InputError for a run that does not fit, Interrupted.
double ideal_signal(const Setup& without, const Setup& with, const IdealSettings& settings,
                    const TrialTools& tools);

/// Returns the products s_i'C^-1 s_j of several changes of one setup, symmetric; their diagonal holds squares
/// of ideal_signal() and may be below zero where there is nothing to see.
std::vector<std::vector<double>> ideal_products(const Setup& without, const std::vector<Setup>& with,
                                                const IdealSettings& settings, const TrialTools& tools);

}  // namespace shakedown
