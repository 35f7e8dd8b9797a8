// SPDX-License-Identifier: MIT
#include "impact_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shakedown::apart {

double pade_restitution(double u) {
  return (1 + 0.501086 * u) / (1 + u * (0.501086 + u * (1.15345 + u * (0.577977 + u * 0.532178))));
}

namespace {

/// Returns u at which the approximant has this value; it falls with u.
double pade_argument(double restitution) {
  double low = 0, high = 10;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (pade_restitution(middle) > restitution ? low : high) = middle;
  }
  return low;
}

}  // namespace

double RestitutionLaw::at(double speed, std::mt19937_64& random) const {
  switch (kind) {
    case Kind::constant: return value;
    case Kind::power:
      return speed > 0 ? std::min(value * std::pow(reference_speed / speed, exponent), std::max(0.98, value))
                       : std::max(0.98, value);
    case Kind::viscoelastic:
      return pade_restitution(pade_argument(value) * std::pow(speed / reference_speed, 0.1));
    case Kind::scattered:
      return std::clamp(std::normal_distribution<double>(value, deviation)(random), 0.0, 1.0);
  }
  return value;
}

LatchingSpring LatchingSpring::of(double restitution, double reduced_mass, double duration) {
  const double e = std::max(restitution, least_restitution),
               rate = std::numbers::pi * (1 + e) / (2 * duration);
  LatchingSpring spring;
  spring.load = reduced_mass * rate * rate;
  spring.unload = spring.load / (e * e);
  return spring;
}

double LatchingSpring::force(double overlap, double deepest) const {
  const double flat = deepest * (1 - load / unload);
  return std::max(0.0, std::min(load * overlap, unload * (overlap - flat)));
}

}  // namespace shakedown::apart
