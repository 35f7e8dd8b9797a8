// SPDX-License-Identifier: MIT
#include "screen_start.hpp"

#include <algorithm>

#include "expect.hpp"
#include "refit.hpp"

namespace shakedown {

ScreenStart start_from(const Refit& fit, const std::vector<Knob>& knobs) {
  ScreenStart start{fit.for_means, fit.covariances};
  const auto cut_off = [](const FittedValue& value) { return value.at_bound; };
  if (fit.at_solution.empty() || knobs.size() != fit.knobs.size() ||
      std::any_of(fit.values.begin(), fit.values.end(), cut_off))
    return start;
  start.knobs = at_values(fit);
  start.emulators = fit.at_solution;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    EXPECT(knobs[k].key == fit.knobs[k].key);
    // What is arithmetic on the recording stays where the recording was read.
    if (!knobs[k].exact) continue;
    const double moved = fit.knobs[k].z_of(fit.values[k].value);
    for (Emulator& e : start.emulators)
      e.coefficients.row(0) -= moved * e.coefficients.row(1 + static_cast<Eigen::Index>(k));
  }
  return start;
}

}  // namespace shakedown
