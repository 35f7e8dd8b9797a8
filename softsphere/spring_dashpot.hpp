// SPDX-License-Identifier: MIT
// Linear spring-dashpot contact: F = k overlap + gamma d(overlap)/dt, attraction at the end allowed. With
// beta = -ln(eps)/t_c, k = mu (pi^2/t_c^2 + beta^2) and gamma = 2 mu beta a binary impact lasts t_c and has
// restitution eps at every speed (Schaefer, Dippel, Wolf 1996, J. Phys. I 6, 5).
#pragma once

namespace shakedown {

struct SpringDashpot {
  double stiffness = 0;  ///< N/m
  double damping = 0;    ///< N s/m
};

/// Returns the constants for a restitution in (0, 1], a reduced mass (kg) and a contact time (s).
SpringDashpot spring_dashpot(double restitution, double reduced_mass, double contact_time);

/// Returns the largest error of the restitution over all phases of first touch within a step: 1.24 / n^2 for
/// n steps per contact, measured at restitution 0.75 (n = 10 ... 200; tests/softsphere holds it).
double predicted_restitution_error(double steps_per_contact);

}  // namespace shakedown
