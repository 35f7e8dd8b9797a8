// SPDX-License-Identifier: MIT
// Which engine a diagnosis simulates with.
#pragma once
#include <string>

#include "diagnosis.hpp"

namespace shakedown {

/// All grains of every run fit into one layer across the motion. They land at once: where contacts last they
/// push each other and the wall all together, hard spheres one after the other, and a layer of restitution
/// 0.75 rebounds with 0.751 and 0.779 of its speed (harness/diagnose/README.md).
bool lie_in_one_layer(const Measurement& measurement);

struct EngineChoice {
  bool lasting_contacts = false;  ///< DiagnoseOptions::lasting_contacts, not the engine that was asked for
  std::string note;               ///< why; empty: the question did not arise
  int runs = 0;                   ///< simulations that it took
};

/// Where all grains lie in one layer and the data reject the model as given by `engine`, it is simulated with
/// contacts that last too, and the engine that leaves the smaller misfit is chosen. `measurement`: each run
/// from where simulations begin. Throws Interrupted.
EngineChoice chosen_engine(const Setup& user, const Measurement& measurement, const Engine& engine,
                           const DiagnoseOptions& options);

}  // namespace shakedown
