// SPDX-License-Identifier: MIT
// What a tangential spring leaves of the slip, in the limit of contacts too short to turn: the soft engine's
// law (softsphere/friction.hpp) integrated over one impact. The normal spring with its dashpot presses with
// k v_n/w exp(-d t) sin(w t) for half a period; the tangential spring of ratio times k, with its own dashpot,
// pulls back and slides at mu times that. Nothing in it depends on the duration. A single coefficient of
// tangential restitution cannot say this: with a ratio other than 2/7 a contact slides at its beginning, at
// its end or at both, and how much depends on the angle (N. Maw, J. R. Barber and J. N. Fawcett, Wear 38, 101
// (1976); linear springs: V. Becker, T. Schwager and T. Poeschel, Phys. Rev. E 77, 011304 (2008)).
#pragma once

namespace shakedown {

struct CompliantSlip {
  double slip_over_limit = 0;         ///< slip before, over mu times the closing speed; > 0
  double felt_mass = 2.0 / 7;         ///< mass that the slip feels, over the reduced mass
  double restitution = 1;             ///< of the normal
  double stiffness_ratio = 2.0 / 7;   ///< tangential spring over the normal one
  double tangential_restitution = 1;  ///< from 0 to 1: the tangential dashpot's
};

/// Returns the rate at which a dashpot of this restitution takes speed, in units of pi over the contact time.
/// Restitutions below 1e-4 count as 1e-4, as in the soft engine.
double dashpot_decay(double restitution);

/// Returns the slip after the impact over that before, -1 to 1. Error: 3e-3, with a tangential dashpot 7e-3.
double compliant_slip(const CompliantSlip& slip);

}  // namespace shakedown
