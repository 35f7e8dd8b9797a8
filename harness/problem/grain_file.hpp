// SPDX-License-Identifier: MIT
#pragma once
#include "initial_state.hpp"

namespace shakedown {

/// Fills positions and velocities from setup.release.initial_grains (CSV id,x,y,z,vx,vy,vz; m and m/s, lab
/// frame with the box at its release position). Throws InputError for a malformed line (with its number), a
/// wrong number of grains, non-finite values, grains that overlap or stick out of the box; FileError when the
/// file cannot be read.
void read_grains(const Setup& setup, State& state);

}  // namespace shakedown
