// SPDX-License-Identifier: MIT
// Simulations that need not be made again: those of this work, written down while it goes on, and those that
// other experiments of one setup have made. What an answer says does not depend on what is kept.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "ensemble_cache.hpp"
#include "features.hpp"
#include "simulation_journal.hpp"

namespace shakedown {

/// What is read off a simulation for one measured run.
struct ReadOff {
  std::string run;
  const FeaturePlan* plan;
};

/// A run of an engine that may have been made before.
struct SimulationAsked {
  const Setup& setup;
  int run;
  std::string_view engine;
};

struct SimulationStore {
  SimulationJournal* journal = nullptr;  ///< of this work, begun before or not; may be null
  EnsembleCache* recordings = nullptr;   ///< shared by experiments of one setup; may be null

  /// Features for each of these, m: as they are kept, or of what `simulate` gives, and kept from then on. May
  /// be called from many threads.
  SimulationJournal::Features find_or_simulate(const SimulationAsked& asked, const std::vector<ReadOff>& read,
                                               const std::function<Recording()>& simulate) const;
};

}  // namespace shakedown
