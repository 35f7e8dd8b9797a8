// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <string>
#include <vector>

#include "engine.hpp"
#include "known_effects.hpp"
#include "result_file.hpp"
#include "sweep_axis.hpp"

namespace shakedown {

struct SweepPoint {
  std::vector<double> values;  ///< SI, one an axis
  Setup setup;
  std::string digest;  ///< of that setup
};

/// Every combination of the axes' values.
struct SweepPlan {
  Setup base;
  std::vector<SweepAxis> axes;
  std::vector<SweepPoint> points;  ///< the last axis runs fastest
  int runs = 1;                    ///< of each point; they differ by their random numbers only
  std::vector<std::string> notes;  ///< what is done otherwise than the setup says
};

/// Makes the plan. Throws InputError with the points that are no possible setup or that the engine does not
/// model.
SweepPlan plan_sweep(const Setup& base, std::vector<SweepAxis> axes, int runs, const Engine& engine,
                     KnownEffects known);

/// Returns what a result file must have been begun with so that this sweep goes on in it.
SweepIdentity identity_of(const SweepPlan& plan, const Engine& engine);

}  // namespace shakedown
