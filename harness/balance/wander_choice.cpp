// SPDX-License-Identifier: MIT
#include "wander_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "balance_rules.hpp"

namespace shakedown {

double most_wander(const std::vector<MomentumRun>& runs, double white) {
  double swing = 0;
  for (const MomentumRun& run : runs)
    if (run.x_box.size() > 0) swing = std::max(swing, (run.x_box.maxCoeff() - run.x_box.minCoeff()) / 2);
  return std::max(most_wander_of_noise * white, most_wander_of_swing * swing);
}

void choose_wander(SelectionProblem& p, double white) {
  const auto evidence = [&](const Wander& wander) {
    p.problem.set_wander(wander);
    p.problem.set_covariance({});
    return log_evidence_of_noise(p);
  };
  const double usual = usual_wander * white;
  // ln of a half-Cauchy prior, by the logarithm of the strength; memories are equally likely.
  const auto prior = [&](double deviation) {
    const double ratio = deviation / usual;
    return std::log(2 * std::numbers::ln2 / std::numbers::pi * ratio / (1 + ratio * ratio));
  };
  Wander best;
  double most = evidence(best) + std::log(2 / std::numbers::pi * std::atan(0.25));
  for (const double time : {0.1, 0.3, 1.0}) {
    // Upwards from a quarter of the usual until it has fallen twice in a row.
    double last = -std::numeric_limits<double>::infinity();
    for (int step = 0, falls = 0; step < 14 && falls < 2; ++step) {
      const Wander wander{0.25 * usual * std::pow(2, step), time};
      const double here = evidence(wander) + prior(wander.deviation) - std::log(3.0);
      falls = here < last ? falls + 1 : 0;
      last = here;
      if (here > most) most = here, best = wander;
    }
  }
  p.problem.set_wander(best);
  p.problem.set_covariance({});
}

}  // namespace shakedown
