// SPDX-License-Identifier: MIT
#pragma once

namespace shakedown {

/// A damper at one moment, lab frame: time, s; position, m, and velocity, m/s, of the box along x;
/// mass-weighted mean x of the grains, m (NaN without grains); energy of grains, box, spring and wells, J.
struct Observation {
  double time, x_box, v_box, x_com, total_energy;
};

}  // namespace shakedown
