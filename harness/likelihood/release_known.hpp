// SPDX-License-Identifier: MIT
#pragma once
#include <span>

#include "known_effects.hpp"
#include "measurement.hpp"

namespace shakedown {

/// Returns the measurement with each run released from where it was seen to be, as far as what the user says
/// of the release allows: a hand does not let go twice at the same place. It weighs what is known of the
/// release (`[known]`, else half a millimetre) against the first frames and the camera's scale. Grains whose
/// places were measured keep their places in the box.
Measurement with_measured_release(Measurement measurement, KnownEffects known);

}  // namespace shakedown
