// SPDX-License-Identifier: MIT
// Observes the damper under harmonic forcing along its axis (effect oscillating_acceleration, or base_motion
// where the base swings as a sine), once the start is forgotten.
#pragma once
#include <optional>

#include "setup.hpp"
#include "trajectory.hpp"

namespace shakedown {

constexpr int forcing_cycles = 40;  ///< simulated
constexpr int steady_cycles = 10;   ///< the last of them, which are looked at
/// An extremum between two of so many samples a cycle is off by (pi / 200)^2 / 2 = 1e-4 of the amplitude ...
constexpr double samples_a_cycle = 200;
/// ... and of so few by 1.2 %: with fewer nothing is said.
constexpr double fewest_samples_a_cycle = 20;

/// Both swing as sin(2 pi f t + phase) along the axis; one of them is zero.
struct SteadyForcing {
  double acceleration = 0;  ///< m/s^2, of all masses
  double frequency = 0;     ///< Hz
  double phase = 0;         ///< rad
  double base = 0;          ///< m, of the far end of the spring
};

/// Tells whether something shakes the damper all the time: it never comes to rest, and its momentum is not
/// the spring's alone.
bool is_shaken(const Setup& setup);

/// Returns the setup's forcing along the axis; nothing when there is none, more than one, or a base that does
/// not swing as a sine up to the end of the run.
std::optional<SteadyForcing> steady_forcing_of(const Setup& setup);

/// Returns the setup with its duration set to the cycles above and at least 200 samples a cycle; unchanged
/// without forcing, and where the base is forced.
Setup long_enough_for_forcing(const Setup& setup);

struct SteadyState {
  double amplitude = 0;  ///< m, half of highest minus lowest position in a cycle, mean over the last cycles
  double variation = 0;  ///< relative standard deviation of that from cycle to cycle: how steady it is
  double phase_lag = 0;  ///< rad in (-pi, pi], of the fundamental of x_box behind the forcing
  /// D / (2 pi k A^2 / 2): energy lost per cycle, by whatever takes it, over 2 pi times the energy stored in
  /// the spring at the amplitude (Lazan, Damping of Materials and Members, 1968).
  double loss_factor = 0;
  /// kg, of the grains: the part in phase of the force that they take over the acceleration of the box, both
  /// at the forcing's frequency: all their mass where they ride along, none where they float; NaN without.
  double effective_mass = 0;
};

/// Returns the state over the last cycles of the trajectory, which must have `steady_cycles` of them and 20
/// samples a cycle; a sweep simulates long_enough_for_forcing(setup). The loss is the work of the forcing,
/// int (M a v_box + N m a v_com) dt or int k b v_box dt, less what the energy grew by (nothing where the
/// trajectory does not say): by parts it needs positions only.
SteadyState steady_state(const Setup& setup, const Trajectory& trajectory);

/// Returns the same where the setup is forced and the trajectory is long and dense enough for it; else
/// nothing.
std::optional<SteadyState> steady_state_if_any(const Setup& setup, const Trajectory& trajectory);

}  // namespace shakedown
