// SPDX-License-Identifier: MIT
// Lets what was weighed and measured go before what the setup says.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "experiment.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Returns the setup with the values of [known]; of the camera those that are not 0 (nothing wrong expected
/// beside what the setup says). What the camera makes late, wide or slanted becomes an effect of the setup.
Setup with_known(Setup setup, const std::vector<KnownValue>& values, KnownEffects known);

/// Returns the experiment with each run's own values of [known] as keys of that run.
Experiment with_known(Experiment experiment, KnownEffects known);

/// Returns the key of the setup that holds this value: its own, or the parameter of the camera's effect;
/// empty: none (a clock, a wander).
std::string setup_key_of(const KnownValue& value, KnownEffects known);

/// Returns what goes for the setup's value, in words for people; nothing where both agree.
std::vector<std::string> notes_on_known(const Setup& setup, const std::vector<KnownValue>& values);

}  // namespace shakedown
