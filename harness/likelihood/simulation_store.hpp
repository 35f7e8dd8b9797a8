// SPDX-License-Identifier: MIT
// Finds simulations that need not be made again: those of this work, written down while it goes on, and those
// that other experiments of one setup have made. What an answer says does not depend on what is kept.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ensemble_cache.hpp"
#include "features.hpp"
#include "simulation_journal.hpp"

namespace shakedown {

/// Says what is read off a simulation for one measured run.
struct ReadOff {
  std::string run;
  const FeaturePlan* plan;
};

/// Names a run of an engine that may have been made before.
struct SimulationAsked {
  const Setup& setup;
  int run;
  std::string_view engine;
};

/// Finds simulations in two stores, either of which may be missing.
struct SimulationStore {
  SimulationJournal* journal = nullptr;  ///< of this work, begun before or not; may be null
  EnsembleCache* recordings = nullptr;   ///< shared by experiments of one setup; may be null

  /// Returns the features for each of `read`, m: as they are kept, or of what `simulate` gives, and kept from
  /// then on. May be called from many threads.
  SimulationJournal::Features find_or_simulate(const SimulationAsked& asked, const std::vector<ReadOff>& read,
                                               const std::function<Recording()>& simulate) const;
};

}  // namespace shakedown
