// SPDX-License-Identifier: MIT
// Below which closing speeds impacts are elastic: this ends the infinite series of impacts in finite time
// ("inelastic collapse") that rigid inelastic bodies are prone to.
#pragma once
#include "physics.hpp"

namespace shakedown {

struct ElasticLimits {
  double wall_fraction = 0.02;  ///< of the box's current top speed, end walls
  double pair_speed = 1e-3;     ///< m/s
  double wall_speed = 0;        ///< m/s, end and side walls
  double free_path = 0;  ///< m; impacts after less of it within `HeldBonds::quick` are elastic at any speed
  double pull =
      -1;  ///< m/s^2, acceleration that presses layers on walls and sets the last; negative: none does
};

/// Returns the limits of a setup at release.
ElasticLimits elastic_limits(const Setup& setup, const Physics& physics);

/// Returns the limits, raised for an acceleration of `pull` (m/s^2) that presses grains of this diameter (m)
/// on walls.
ElasticLimits pressed_by(double pull, ElasticLimits limits, double diameter);

}  // namespace shakedown
