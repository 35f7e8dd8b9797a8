// SPDX-License-Identifier: MIT
// Computes the motion of a box without grains, fast enough to be fitted: Runge-Kutta of fourth order in equal
// steps that end where a friction turns. A box alone has no chaos; where there are grains an engine is
// needed.
#pragma once
#include <vector>

#include "physics.hpp"

namespace shakedown {

/// Says where the box is at first.
struct SwingStart {
  double position = 0, velocity = 0;  ///< m, m/s, at the first of the times
};

/// Steps a period of the spring. The phase is off by 4e-7 of what it has turned; Hermite's cubic between two
/// steps by 3e-7 of the amplitude.
constexpr int steps_a_period = 64;

/// Returns the positions of the box, m, at these times (s, ascending). Empty where the box goes further than
/// `farthest`, m, or where a force is no number.
std::vector<double> swing_of(const Physics& physics, const SwingStart& start, const std::vector<double>& time,
                             double farthest);

}  // namespace shakedown
