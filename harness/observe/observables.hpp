// SPDX-License-Identifier: MIT
// The numbers by which runs, engines and experiments are compared.
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "decay.hpp"
#include "setup.hpp"
#include "steady_forcing.hpp"
#include "trajectory.hpp"

namespace shakedown {

/// Fractions of the initial energy whose times are reported.
constexpr std::array<double, 5> energy_fractions{0.5, 0.25, 0.1, 0.05, 0.01};

/// SI; `absent` (NaN) where a run has no such number.
struct Observables {
  std::vector<double> zero_crossings;  ///< s
  std::vector<Peak> peaks;             ///< one signed extremum a half period, the release excluded
  double frequency = absent;           ///< Hz, of the first ten zero crossings
  double slope = absent;               ///< m/s, of |peaks| against time
  double small_peak = absent;          ///< m, below which a peak is small
  double first_small_peak = absent;    ///< s, time of the first small peak
  Decay decay;
  std::vector<HalfPeriodDamping> damping;  ///< one entry a half period, from the release on
  std::array<double, energy_fractions.size()> seconds_to_energy_fraction{};
  std::array<double, contact_classes>
      energy_loss{};                  ///< by class of contact, fractions of the initial energy, at the end
  std::vector<double> effect_loss;    ///< by line of Setup::effects, likewise
  std::optional<SteadyState> steady;  ///< of a forced damper, over its last cycles
};

/// Returns the observables of one motion; what it does not tell is `absent`.
Observables observe(const Trajectory& trajectory, const Setup& setup);

/// Returns the height below which a peak is small, m: small_share of the release.
double small_peak(const Setup& setup);

/// Returns the shortest time between two zero crossings that counts as a half period: a tenth of the empty
/// box's, s.
double shortest_half_period(const Setup& setup);

/// Returns the first time at which the total energy is at most `fraction` of the initial energy, s,
/// interpolated; absent when never.
double seconds_to_energy_fraction(const Trajectory& trajectory, double fraction);

}  // namespace shakedown
