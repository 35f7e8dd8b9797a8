// SPDX-License-Identifier: MIT
// A made-up experiment with a known momentum balance: the grains are one heavy mass that is carried to and
// fro in the box on a prescribed path, with kinks like landings, and the box answers under any force from
// outside.
#pragma once
#include <functional>

#include "experiment.hpp"

namespace shakedown {

struct PushedBox {
  std::function<double(double x, double v, double t)> force;  ///< N on the box; empty: none
  double dry_friction = 0;                                    ///< N
  double extra_mass = 0;                                      ///< kg, added to the box with the spring kept
  double cubic = 0;                                           ///< spring force -k x (1 + cubic (x/Delta0)^2)
  double acceleration = 0;                                    ///< m/s^2, on box and grains
  double viscous = 0;                                         ///< N s/m; also makes the motion die away
  bool grains = true;
  double duration = 12, rate = 250;
  double box_noise = 2e-4, com_noise = 5e-4, colour = 0;
};

/// Runs at 40, 65 and 104 mm. Setups that go with them are defaults with the run's box length.
Experiment pushed_box(const PushedBox& what, std::uint64_t seed);
std::vector<Setup> pushed_setups(const Experiment& experiment);

}  // namespace shakedown
