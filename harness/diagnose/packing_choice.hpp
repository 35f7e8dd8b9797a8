// SPDX-License-Identifier: MIT
#pragma once
#include "known_effects.hpp"
#include "measurement.hpp"
#include "setup.hpp"

namespace shakedown {

struct PackingChoice {
  Packing packing;
  double apart = 0;  ///< m, rms from where this packing has the grains' centre; 0 where nothing was measured
  bool fits = true;  ///< as near as the grains of such a packing are laid
};

/// The grains' centre in the box before anything has moved tells the packing: the arrangements differ by
/// millimetres. A camera's bias or scale shortens all distances by the same share, which box lengths tell
/// from a packing. The setup's own where no other is clearly nearer, or where nothing was measured.
PackingChoice packing_before_release(const Setup& setup, const Measurement& measurement, KnownEffects known);

}  // namespace shakedown
