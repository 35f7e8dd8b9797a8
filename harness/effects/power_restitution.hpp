// SPDX-License-Identifier: MIT
// Restitution that falls as a power of the closing speed.
#pragma once
#include <algorithm>
#include <cmath>

namespace shakedown {

/// Returns the restitution at a speed, m/s: plastic contacts lose the more the faster they are. The cap keeps
/// slow impacts dissipative; materials that are more elastic than the cap at the reference speed keep their
/// value.
inline double power_restitution(double at_reference, double exponent, double reference, double speed) {
  constexpr double cap = 0.98;
  return std::min(at_reference * std::pow(speed / reference, -exponent), std::max(cap, at_reference));
}

}  // namespace shakedown
