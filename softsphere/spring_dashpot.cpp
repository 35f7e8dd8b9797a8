// SPDX-License-Identifier: MIT
#include "spring_dashpot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shakedown {

SpringDashpot spring_dashpot(double restitution, double reduced_mass, double contact_time) {
  // Below 1e-4 the dashpot rate would outrun the step without a visible difference in the bounce.
  const double decay = -std::log(std::clamp(restitution, 1e-4, 1.0)) / contact_time;
  const double rate = std::numbers::pi / contact_time;
  return {reduced_mass * (rate * rate + decay * decay), 2 * reduced_mass * decay};
}

double predicted_restitution_error(double steps_per_contact) {
  return 1.24 / (steps_per_contact * steps_per_contact);
}

}  // namespace shakedown
