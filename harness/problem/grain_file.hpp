// SPDX-License-Identifier: MIT
#pragma once
#include "damper_state.hpp"

namespace shakedown {

/// Measured positions err by so much, and touching grains then overlap; deeper overlaps are mistakes.
constexpr double most_measured_overlap = 5e-5;  // m

/// Fills positions and velocities from setup.release.initial_grains (CSV id,x,y,z,vx,vy,vz; m and m/s, lab
/// frame with the box at its release position, or at grains_measured_at: they have moved with it). Throws
/// InputError for a malformed line (with its number), a wrong number of grains, non-finite values, grains
/// that overlap or stick out of the box; FileError when the file cannot be read. Overlaps up to
/// most_measured_overlap are pushed apart, and State::pushed_apart says how far.
void read_grains(const Setup& setup, State& state);

}  // namespace shakedown
