// SPDX-License-Identifier: MIT
#pragma once
#include "measurement.hpp"
#include "refit_result.hpp"
#include "slow_wander.hpp"

namespace shakedown {

/// Holds how a model as given compares, and with what.
struct JudgedAsGiven {
  std::vector<MeasuredFeatures> measured;  ///< the features of each run, with what camera and weights may do
  Refit fit;
};

/// Compares the model as the setup gives it with these runs: camera, clock, masses and releases are fitted
/// within what is known of them, parameters within what two codes of one physics differ by (as_given()).
/// `measurement`: with_measured_release(); `wander`: of its tracks; `count`: simulations of each different
/// setup. Throws as refit() does.
JudgedAsGiven judged_as_given(const Setup& setup, const Measurement& measurement, const Wander& wander,
                              const Workshop& workshop, int count);

}  // namespace shakedown
