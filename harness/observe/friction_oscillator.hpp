// SPDX-License-Identifier: MIT
// The friction-damped oscillator, M_tot x'' = -k x - F sgn(x') (paper, Eq. frictDamper), piecewise in closed
// form: during half period n it swings about (-1)^n F/k, so each |peak| is 2F/k below the one before; it
// sticks for good where |x| <= F/k.
#pragma once
#include "peaks.hpp"

namespace shakedown {

struct FrictionOscillator {
  double stiffness = 0;   ///< N/m
  double total_mass = 0;  ///< kg
  double friction = 0;    ///< N, >= 0
  double release = 0;     ///< m, > 0, from rest

  double half_period() const;  ///< s
  Peak extremum(int n) const;  ///< the n-th turning point; n = 0 is the release; stays at the last one
  int last_extremum() const;   ///< number of the turning point where it sticks
  double position_at(double time) const;  ///< m, at a time >= 0, s since release
  double velocity_at(double time) const;  ///< m/s, likewise
};

/// Returns the friction that the paper reads off a run, N: k (Delta0 - |x_n|) / (2 n), with `peak` = x_n, m,
/// the n-th extremum after release (Eq. frictioncoeff).
double effective_friction(double stiffness, double release, double peak, int n = 3);

}  // namespace shakedown
