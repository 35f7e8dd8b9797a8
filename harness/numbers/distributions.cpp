// SPDX-License-Identifier: MIT
#include "distributions.hpp"

#include <cmath>
#include <numbers>

// The special functions need Eigen's core before them.
#include <Eigen/Core>
#include <unsupported/Eigen/SpecialFunctions>

#include "expect.hpp"

namespace shakedown {

double chi_squared_tail(double value, double degrees) {
  EXPECT(degrees > 0);
  if (std::isnan(value)) return value;
  if (std::isinf(value)) return value > 0 ? 0 : 1;
  return value > 0 ? Eigen::numext::igammac(degrees / 2, value / 2) : 1;
}

double student_two_sided_tail(double value, double degrees_of_freedom) {
  const double square = value * value;
  return Eigen::numext::betainc(degrees_of_freedom / 2, 0.5,
                                degrees_of_freedom / (degrees_of_freedom + square));
}

double student_95(double degrees_of_freedom) {
  EXPECT(degrees_of_freedom >= 1);
  const double nu = degrees_of_freedom;
  const double norm =
      std::exp(std::lgamma((nu + 1) / 2) - std::lgamma(nu / 2)) / std::sqrt(nu * std::numbers::pi);
  // Newton's method from the normal distribution's value, which is too small: the tail is convex, so every
  // step stays below the solution and the last ones double the digits.
  double t = normal_95;
  for (double step = 1; step > 1e-12 * t;) {
    const double density = norm * std::pow(1 + t * t / nu, -(nu + 1) / 2);
    step = (student_two_sided_tail(t, nu) - 0.05) / (2 * density);
    t += step;
  }
  return t;
}

}  // namespace shakedown
