// SPDX-License-Identifier: MIT
#include "compliant_slip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shakedown {

namespace {
/// Takes this many steps per contact, which costs one to two microseconds an impact.
constexpr int steps = 400;

}  // namespace

double dashpot_decay(double restitution) {
  return -std::log(std::clamp(restitution, 1e-4, 1.0)) / std::numbers::pi;
}

/// Computes in units of the rate pi / contact time, the reduced mass, and mu times the closing speed.
double compliant_slip(const CompliantSlip& law) {
  constexpr double turning = 2.0 / 7, step = std::numbers::pi / steps;
  const double decay = dashpot_decay(law.restitution), across = dashpot_decay(law.tangential_restitution);
  const double stiffness = 1 + decay * decay;
  const double spring = law.stiffness_ratio * stiffness + turning * across * across,
               dashpot = 2 * turning * across;
  // exp(-decay t) (cos t, sin t) at the middles of the steps, by turning on
  const double shrunk = std::exp(-decay * step), cosine = shrunk * std::cos(step),
               sine = shrunk * std::sin(step), shrunk_first = std::exp(-decay * step / 2);
  double c = shrunk_first * std::cos(step / 2), s = shrunk_first * std::sin(step / 2);
  double slip = law.slip_over_limit, stretch = 0;
  for (int k = 0; k < steps; ++k) {
    stretch += slip * step / 2;
    const double wanted = -spring * stretch - dashpot * slip, most = stiffness * s;
    const double force = std::clamp(wanted, -most, most);
    if (force != wanted) {  // slides: the spring keeps what its share of the force stands for
      const double of_spring = force + dashpot * slip;
      stretch = of_spring * force <= 0 ? 0 : -of_spring / spring;
    }
    slip += force / law.felt_mass * step;
    stretch += slip * step / 2;
    const double turned = c * cosine - s * sine;
    s = s * cosine + c * sine;
    c = turned;
  }
  return std::clamp(slip / law.slip_over_limit, -1.0, 1.0);
}

}  // namespace shakedown
