// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "physics.hpp"

namespace shakedown {

/// Centres of grains of the given radii at release, in the frame of the box (x = 0 its centre). Deterministic
/// in (seed, run). Throws InputError when they do not fit.
std::vector<Vec3> packed_centres(const Setup& setup, Packing packing, const std::vector<double>& radius,
                                 int run);

}  // namespace shakedown
