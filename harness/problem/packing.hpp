// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <vector>

#include "physics.hpp"

namespace shakedown {

/// Returns the centres of grains of the given radii (m) at release, m, in the frame of the box (x = 0 its
/// centre). Deterministic in (seed, run). Throws InputError when they do not fit, Interrupted when it is
/// asked to stop.
std::vector<Vec3> packed_centres(const Setup& setup, Packing packing, const std::vector<double>& radius,
                                 int run);

/// Lets packings that take long stop once this is true. It must outlive every packing.
void stop_packing_when(const std::atomic<bool>* asked);

/// Throws Interrupted once it is asked to stop; for loops over grains.
void expect_packing_goes_on();

}  // namespace shakedown
