// SPDX-License-Identifier: MIT
#include "fisher_tail.hpp"

// The special functions need Eigen's core before them.
#include <Eigen/Core>
#include <unsupported/Eigen/SpecialFunctions>

#include "expect.hpp"

namespace shakedown {

double fisher_tail(double value, double degrees_above, double degrees_below) {
  EXPECT(degrees_above > 0 && degrees_below > 0);
  if (!(value > 0)) return 1;
  return Eigen::numext::betainc(degrees_below / 2, degrees_above / 2,
                                degrees_below / (degrees_below + degrees_above * value));
}

}  // namespace shakedown
