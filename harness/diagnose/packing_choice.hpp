// SPDX-License-Identifier: MIT
#pragma once
#include "known_effects.hpp"
#include "measurement.hpp"
#include "setup.hpp"

namespace shakedown {

/// Holds a packing and how well it fits.
struct PackingChoice {
  Packing packing;
  double apart = 0;  ///< m, rms from where this packing has the grains' centre; 0 where nothing was measured
  bool fits = true;  ///< the centre lies as near as the grains of such a packing are laid
};

/// Chooses the packing by the grains' centre in the box before anything has moved, in which the arrangements
/// differ by millimetres. A camera's bias or scale shortens all distances by the same share, which box
/// lengths tell from a packing. Returns the setup's own where no other is clearly nearer, or where nothing
/// was measured.
PackingChoice packing_before_release(const Setup& setup, const Measurement& measurement, KnownEffects known);

}  // namespace shakedown
