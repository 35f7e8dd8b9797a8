// SPDX-License-Identifier: MIT
// Tells the paper's closed-form estimates for a setup, and the friction-damped oscillator that a run
// suggests.
#pragma once
#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "engine.hpp"
#include "friction_oscillator.hpp"
#include "theory.hpp"

namespace shakedown {

/// Holds the friction-damped oscillator that one run of the setup suggests.
struct FrictionOfRun {
  FrictionOscillator oscillator;
  double third_peak = 0;      ///< m, of the run
  double rms_difference = 0;  ///< m, between the two motions of the box over the whole run
};

/// Reads it off a run; nothing when the run has fewer than three peaks. `stop`: may be null; `progress`: may
/// be empty. Throws Interrupted, and what the engine throws.
std::optional<FrictionOfRun> friction_of_run(const Theory& theory, const Setup& setup, const Engine& engine,
                                             const std::atomic<bool>* stop,
                                             const std::function<void(double fraction)>& progress);

/// Returns the oscillator's motion at the setup's samples as a table t_s,x_box_m,v_box_m_per_s.
std::string friction_csv(const FrictionOscillator& oscillator, const Setup& setup);

/// Holds all that is estimated.
struct Estimated {
  Theory theory;
  std::optional<FrictionOfRun> friction;
  std::string engine;  ///< of the run, as the user named it
};

/// Returns the estimates as text for a terminal.
std::string estimated_text(const Estimated& estimated);
/// Returns them as JSON text.
std::string estimated_json(const Estimated& estimated);

}  // namespace shakedown
