// SPDX-License-Identifier: MIT
#include "trajectory.hpp"

namespace shakedown {

double Ledger::total_loss() const {
  double sum = 0;
  for (const double loss : contact_loss) sum += loss;
  for (const double loss : effect_loss) sum += loss;
  return sum;
}

}  // namespace shakedown
