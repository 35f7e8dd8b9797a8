// SPDX-License-Identifier: MIT
// What a run of the exact engine must keep to be given out.
#pragma once
#include "trajectory.hpp"

namespace shakedown {

/// Largest error of the energy balance, as a fraction of the energy.
constexpr double most_ledger_error = 1e-9;
/// Deepest overlap of grains and walls, m.
constexpr double most_overlap = 1e-12;

/// Throws PhysicsError, with time (s), reason and remedy, where the energy is not finite (`most_energy`, J:
/// the most that box and grains held so far), where its balance is off by more than most_ledger_error, or
/// where surfaces overlap by more than most_overlap.
void expect_kept(const Health& health, double time, double most_energy);

}  // namespace shakedown
