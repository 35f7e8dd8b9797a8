// SPDX-License-Identifier: MIT
// Finds what a film shows before the box swings freely: it rests, is pulled aside, is held, and let go.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "experiment.hpp"

namespace shakedown {

struct Prelude {
  double release = 0;  ///< s, on the clock of the series
  double held = 0;     ///< s that it stood still directly before; 0: it turned there
};

/// Returns the release after a prelude; nothing where the series begins with the free swing, or where the
/// frames do not tell. `x`: m, NaN where missing, without wrong frames; `deviation`: m, of one frame's noise.
std::optional<Prelude> prelude_of(const std::vector<double>& time, const std::vector<double>& x,
                                  double deviation);

/// Returns the run with its clock counted from this time of it, s, and what comes before as its lead-in.
MeasuredRun counted_from(MeasuredRun run, double release);

/// Counts runs whose release the experiment does not say from where the frames show it. What was done joins
/// the experiment's notes, with the line that says the same. `setups` are those of the runs.
Experiment with_releases_seen(Experiment experiment, const std::vector<Setup>& setups);

}  // namespace shakedown
