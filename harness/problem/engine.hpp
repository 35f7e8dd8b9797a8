// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string_view>

#include "damper_state.hpp"
#include "trajectory.hpp"

namespace shakedown {

struct RunOptions {
  int run = 0;  ///< number of the run in its ensemble; addresses the random numbers
  /// Called now and then with the simulated time, s; may be empty.
  std::function<void(double time)> progress;
  /// Set to true (by a signal handler, say) to stop early; the trajectory then holds what was done.
  const std::atomic<bool>* stop = nullptr;
  bool log_collisions = false;  ///< keep Trajectory::collision_log (event-driven engines; others ignore it)
};

/// The one interface behind which models of the damper compete.
class Engine {
 public:
  virtual ~Engine() = default;
  /// Returns the name by which setups, options and results call it: "hard".
  virtual std::string_view name() const = 0;
  /// Returns how faithfully it models an effect, whatever the choice of parameters.
  virtual Capability can_model(const EffectRecord& effect) const = 0;
  /// Runs the setup from its initial state. Throws InputError for what the engine cannot model, PhysicsError
  /// (with time, grains and state) when it cannot keep its promise. Thread-safe: runs share nothing.
  virtual Trajectory run(const Setup& setup, const RunOptions& options = {}) const = 0;
};

/// Throws InputError naming each effect of the setup that the engine does not model, with its place and what
/// to use instead.
void refuse_what_is_not_modelled(const Engine& engine, const Setup& setup);

}  // namespace shakedown
