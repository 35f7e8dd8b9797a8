// SPDX-License-Identifier: MIT
// Two viscoelastic spheres: Hertz's force with a dashpot, F = k (xi^(3/2) + (3/2) A xi^(1/2) xi'), never
// attractive. In units of its own speed and depth the contact is x'' = -(x^(3/2) + b x^(1/2) x'), x(0) = 0,
// x'(0) = 1, with the one number b = (3/2) A (k/m)^(2/5) v^(1/5): the restitution depends on the closing
// speed v through v^(1/5) alone. The contact ends where the force vanishes, before the surfaces are back
// (delayed recovery). For small b: eps = 1 - 1.15344 b + 0.79826 b^2. Sources: N. V. Brilliantov, F. Spahn,
// J.-M. Hertzsch and T. Poeschel, Phys. Rev. E 53, 5382 (1996); R. Ramirez et al., Phys. Rev. E 60, 4465
// (1999), the series; T. Schwager and T. Poeschel, Phys. Rev. E 78, 051304 (2008).
#pragma once

namespace shakedown {

/// Returns the restitution by integrating the contact, b >= 0; error below 1e-11.
double solved_viscoelastic_restitution(double b);

/// Returns the same from a table made once (70 ms); error below 1e-10 for restitutions above 3.3e-3, 2e-5
/// below. Thread-safe.
double viscoelastic_restitution(double b);

/// Returns the b that gives a restitution in (0, 1]; below 3.3e-3 the end of the table.
double viscoelastic_damping(double restitution);

/// Duration of an undamped contact times (k/m)^(2/5) v^(1/5).
constexpr double hertz_duration = 3.218065459719045;

}  // namespace shakedown
