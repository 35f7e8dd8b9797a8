// SPDX-License-Identifier: MIT
// All engines begin with one initial state.
#pragma once
#include <string>

#include "damper_state.hpp"

namespace shakedown {

/// Returns the state at release of run number `run` (>= 0). Random numbers are addressed by (seed, run,
/// stream), so any run can be made alone. Throws InputError when the grains do not fit, overlap or leave the
/// box; FileError when the grain file cannot be read.
State initial_state(const Setup& setup, int run = 0);

/// Returns a sentence for people when the setup's measured grains had to be pushed apart; empty when not.
std::string note_on_measured_grains(const Setup& setup);

}  // namespace shakedown
