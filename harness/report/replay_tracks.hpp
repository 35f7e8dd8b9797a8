// SPDX-License-Identifier: MIT
#pragma once
#include "collision_log_file.hpp"
#include "report.hpp"

namespace shakedown {

struct ReplayPlan {
  std::string group, title;
  double exact_from = 0, exact_to = 0;  ///< s; there no impact is left out
  double until = 1e9;                   ///< s, end of the replay
  std::size_t largest = 200'000;        ///< bytes, packed and compressed: the tolerance grows until it fits
  double tolerance = 2e-5;              ///< m, to begin with
};

/// Returns the motion of a logged run as points between which everything flies straight: every impact, and a
/// point each 10 ms of a bent flight; outside the exact interval points are left out as long as no drawn
/// grain is further than the tolerance from the simulated one.
ReportReplay replay_of(const StoredRun& run, const ReplayPlan& plan);

}  // namespace shakedown
