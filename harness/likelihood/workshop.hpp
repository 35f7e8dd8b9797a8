// SPDX-License-Identifier: MIT
// Says who simulates, how, and where simulations are kept.
#pragma once
#include <cstdint>
#include <functional>

#include "engine.hpp"
#include "execution.hpp"
#include "known_effects.hpp"
#include "simulation_pool.hpp"
#include "simulation_store.hpp"

namespace shakedown {

/// Says who is asked for simulations and who hears of them.
struct SimulationMeter {
  std::function<void(int runs)> done{};  ///< told of finished simulations, one at a time; may be empty
  /// Throws BudgetSpent where so many more simulations are too many; called from several threads; may be
  /// empty.
  std::function<void(std::int64_t more)> ask_for{};
};

/// Holds what simulations are made with.
struct Workshop {
  const Engine* engine = nullptr;
  KnownEffects known{};
  Execution execution{};
  /// What was simulated before, from which regressions learn too, and where new simulations go; may be null.
  SimulationPool* pool = nullptr;
  SimulationStore store{};
  SimulationMeter meter{};

  /// Is called before each batch of so many simulations and, with 0, by every simulation at its start and now
  /// and then on its way. Throws Interrupted once it was stopped, and BudgetSpent.
  void ask(std::int64_t more) const;
  /// Tells of so many finished simulations.
  void finished(int runs) const {
    if (meter.done) meter.done(runs);
  }
};

}  // namespace shakedown
