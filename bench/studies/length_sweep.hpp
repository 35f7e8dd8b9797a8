// SPDX-License-Identifier: MIT
// Finds how long the damper needs to lose its energy, against the length of its box.
#pragma once
#include <array>
#include <vector>

#include "damper_runs.hpp"

namespace shakedown {

/// Times are told for these shares of the energy lost.
constexpr std::array<double, 4> lost_fractions{0.5, 0.75, 0.9, 0.95};

struct LengthPoint {
  double length = 0;                 ///< m
  std::array<Statistic, 4> seconds;  ///< over the runs that got so far
  std::array<int, 4> censored{};     ///< runs that did not
};

struct LengthSweep {
  Setup base;
  std::vector<LengthPoint> points;
  /// Returns the index of the point that loses 95 % soonest among those that no run was censored at.
  std::size_t fastest() const;
};

/// Simulates each length (m). Runs last 60 s times 1.23 Hz over the setup's frequency. Throws Interrupted.
LengthSweep sweep_lengths(const Engine& engine, const Setup& base, const std::vector<double>& lengths,
                          const RunsWanted& wanted);

}  // namespace shakedown
