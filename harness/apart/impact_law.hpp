// SPDX-License-Identifier: MIT
// What an impact of two bodies does along their normal, coded apart from the effects.
#pragma once
#include <cstdint>
#include <random>

namespace shakedown::apart {

/// Restitution of one kind of contact, as a function of the closing speed.
struct RestitutionLaw {
  enum class Kind { constant, power, viscoelastic, scattered };
  Kind kind = Kind::constant;
  double value = 1;            ///< at the reference speed; the mean where it is scattered
  double exponent = 0;         ///< of `power`
  double reference_speed = 1;  ///< m/s
  double deviation = 0;        ///< of `scattered`

  /// Returns the restitution, between 0 and 1, at `speed` >= 0, m/s.
  double at(double speed, std::mt19937_64& random) const;
};

/// Returns the restitution of two viscoelastic spheres for u = b^(1/2), b the number of harness/effects: the
/// Pade approximant of P. Mueller and T. Poeschel, Phys. Rev. E 84, 021302 (2011), Eq. 21, whose coefficients
/// are universal. It is within 1.4e-3 of the integrated contact for u <= 0.6, 5e-3 at 1, 9e-3 at 1.5
/// (restitution 0.19).
double pade_restitution(double u);

/// A spring that loads at one stiffness and unloads at a greater one along a line through its deepest point
/// (O. R. Walton and R. L. Braun, J. Rheol. 30, 949 (1986)): what is lost depends on the depth alone, so that
/// the restitution is (load/unload)^(1/2) at every speed, without a dashpot.
struct LatchingSpring {
  double load = 0, unload = 0;  ///< N/m

  /// Returns the spring of this restitution, reduced mass (kg) and duration (s): loading and unloading take a
  /// quarter period each.
  static LatchingSpring of(double restitution, double reduced_mass, double duration);
  /// Returns the force at this overlap when `deepest` was the greatest one so far (m), N; zero where the
  /// surfaces have parted.
  double force(double overlap, double deepest) const;
  /// Returns the energy that the spring gives back from this force (N), J.
  double stored(double newton) const { return newton * newton / (2 * unload); }
};

/// Lower restitutions unload with the stiffness of this one, as steps could not follow a greater one.
constexpr double least_restitution = 0.1;

}  // namespace shakedown::apart
