// SPDX-License-Identifier: MIT
// Finds what the frames themselves say, before any model: noise and its colour, outliers, gaps, release,
// packed layer.
#pragma once
#include <string>
#include <vector>

#include "experiment.hpp"
#include "noise.hpp"
#include "release_found.hpp"

namespace shakedown {

struct RunAudit {
  std::string run;
  double frame_interval = 0;  ///< s
  NoiseFound box, com;        ///< com: zero standard deviation when not measured
  ReleaseFound release;       ///< of the box
  double plateau = 0;  ///< m, |x_com - x_box| while the grains lie packed at an end wall; NaN without x_com
  double plateau_error = 0;          ///< m
  std::vector<double> x_box, x_com;  ///< the run's series with outliers taken out (NaN)
};

/// Finds noise, outliers, wander and release of one run, from its frames alone.
RunAudit audit_run(const MeasuredRun& run);

/// Pools the noise of runs that one camera filmed: its colour is the same in runs of one frame rate, and so
/// is its noise unless runs differ by more than the error of each. Pooling halves that error, which otherwise
/// widens the test of the momentum balance. `runs[i]` was found by audit_run in `recorded[i]`.
void pool_noise(const std::vector<const MeasuredRun*>& recorded, const std::vector<RunAudit*>& runs);

/// Returns what the frames of a run give reason to say, sentences for people.
std::vector<std::string> warnings_of(const RunAudit& run);

}  // namespace shakedown
