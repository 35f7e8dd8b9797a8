// SPDX-License-Identifier: MIT
// Random numbers addressed by (seed, run, stream): no state is shared, so results cannot depend on threads or
// order. Generator: SplitMix64 (Steele, Lea, Flood 2014), started at a mix of the address. Normal deviates:
// Box and Muller.
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

namespace shakedown {

/// What a stream of random numbers is for; one each, so that adding a use never shifts another.
enum class Stream : std::uint64_t {
  velocities = 1,
  packing = 2,
  diameters = 3,
  camera = 4,
  bootstrap = 5,
  hidden = 6,
  other = 7,
  wander = 8,
  by_run = 9,
  jitter = 10
};

class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t run, Stream stream)
      : state_(mix(mix(mix(seed + 0x9e3779b97f4a7c15u) ^ run) ^ static_cast<std::uint64_t>(stream))) {}

  /// Draws 64 random bits.
  std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }
  /// Draws a number uniform in (0, 1).
  double uniform() { return (static_cast<double>(bits() >> 11) + 0.5) * 0x1p-53; }
  /// Draws a standard normal deviate.
  double normal() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  /// Returns z with its bits mixed, as SplitMix64 does it.
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace shakedown
