// SPDX-License-Identifier: MIT
// The steady acceleration of a setup (gravity) beside the one that shakes its grains.
#pragma once
#include <string>

#include "setup.hpp"

namespace shakedown {

struct SteadyPull {
  double along = 0;   ///< m/s^2 on the grains, along the motion, towards the release
  double across = 0;  ///< m/s^2, magnitude
  double rest = 0;    ///< m; where it holds the box
  /// m/s^2; greatest acceleration of the box at release, omega^2 times its distance from `rest`; 0: no spring
  double shaking = 0;

  double strength() const;  ///< m/s^2
  /// Shaking over the pull (the vibration intensity of granular beds, A omega^2 / g); infinite without a
  /// pull.
  double ratio() const;
};
/// Returns the steady pull of a setup and the shaking beside it.
SteadyPull steady_pull(const Setup& setup);

/// Returns the ratio in words, "2.2 (6.42 m/s^2 against 2.94 m/s^2)"; empty without a steady pull or a
/// spring.
std::string words_of_pull(const SteadyPull& pull);

/// Returns what is to be known before a model of hard spheres is judged under this pull; empty without one.
std::string note_on_pull(const SteadyPull& pull);

}  // namespace shakedown
