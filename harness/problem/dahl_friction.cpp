// SPDX-License-Identifier: MIT
#include "dahl_friction.hpp"

#include <algorithm>
#include <limits>

namespace shakedown {

double DahlState::shortest_travel() const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const DahlFriction& joint : joints_) shortest = std::min(shortest, joint.travel);
  return shortest;
}

}  // namespace shakedown
