// SPDX-License-Identifier: MIT
// Chooses the engine that a diagnosis simulates with.
#pragma once
#include <optional>
#include <string>

#include "state.hpp"

namespace shakedown {

/// Tells whether all grains of every run fit into one layer across the motion. They land at once: where
/// contacts last they push each other and the wall all together, hard spheres one after the other, and a
/// layer may rebound with 0.751 and 0.779 of its speed (harness/diagnose/README.md).
bool lie_in_one_layer(const Measurement& measurement);

/// Says which engine was chosen, and why.
struct EngineChoice {
  bool lasting_contacts = false;  ///< DiagnoseOptions::lasting_contacts, not the engine that was asked for
  std::string note;               ///< why; empty: the question did not arise
  /// The fit of `model` to the first periods, if soft contacts were chosen.
  std::optional<Refit> fit{};
};

/// Fits `model` to its first periods where all grains lie in one layer. Where the data reject it by the
/// engine of the tools it is fitted with contacts that last too, and the engine that leaves the smaller
/// misfit is chosen. `model`: its parameters free, and what the momentum balance found in it; else a
/// restitution or a force that is wrong in both engines decides instead of the contacts. Throws Interrupted.
EngineChoice chosen_engine(const DiagnosisState& model, DiagnosisTools& tools);

}  // namespace shakedown
