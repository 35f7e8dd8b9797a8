// SPDX-License-Identifier: MIT
// Computes how the mean motion of every measured run changes as the numbers of the model are turned: from the
// slopes of the last fit, and from simulations at some places that are made for it. A page moves its curves
// by this without simulating anything.
#pragma once
#include <string>
#include <vector>

#include "execution.hpp"
#include "turned_numbers.hpp"

namespace shakedown {

/// Says what is offered beside the fitted numbers, and how much is simulated.
struct TurnedOptions {
  KnownEffects known;
  std::vector<std::string> missing;   ///< effects found
  std::vector<std::string> suspects;  ///< effects that are offered besides, most wanted first
  int count = 24;                     ///< simulations of each different setup at each place
  int first_run = 7000000;            ///< addresses their random numbers
  double seconds = 60;                ///< for simulations, at most
  Execution execution{};
};

/// Returns the numbers of the fit that can be turned, and what they do. `user`: the setup as given. Simulates
/// with `engine`; what it cannot simulate, or has no time for, is left to straight lines and named.
TurnedModel turned_model(const EnsembleFit& fit, const Setup& user, const Engine& engine,
                         const TurnedOptions& options);

}  // namespace shakedown
