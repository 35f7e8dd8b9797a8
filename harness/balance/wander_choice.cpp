// SPDX-License-Identifier: MIT
#include "wander_choice.hpp"

#include <Eigen/Cholesky>
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

namespace {

void take(SelectionProblem& p, const Wander& wander) {
  p.problem.set_wander(wander);
  p.problem.set_covariance({});
}

/// Returns ln of a half-Cauchy prior, by the logarithm of the strength; memories are equally likely. No
/// wander has the prior of what lies below a quarter of the usual.
double log_prior_of(const Wander& wander, double usual) {
  if (wander.deviation == 0) return std::log(2 / std::numbers::pi * std::atan(0.25));
  const double ratio = wander.deviation / usual;
  return std::log(2 * std::numbers::ln2 / std::numbers::pi * ratio / (1 + ratio * ratio)) - std::log(3.0);
}

}  // namespace

void choose_wander(SelectionProblem& p, double white) {
  const double usual = usual_wander * white;
  const auto probability = [&](const Wander& wander) {
    take(p, wander);
    return log_evidence_of_noise(p) + log_prior_of(wander, usual);
  };
  constexpr int most_steps = 14;  // to two thousand times the usual
  Wander best;
  double most = probability(best);
  for (const double time : {0.1, 0.3, 1.0}) {
    // Go upwards from a quarter of the usual until it has fallen twice in a row.
    double last = -std::numeric_limits<double>::infinity();
    for (int step = 0, falls = 0; step < most_steps && falls < 2; ++step) {
      const Wander wander{0.25 * usual * std::pow(2, step), time};
      const double here = probability(wander);
      falls = here < last ? falls + 1 : 0;
      last = here;
      if (here > most) most = here, best = wander;
    }
  }
  take(p, best);
}

bool choose_wander_beside(SelectionProblem& p, double white, const std::vector<ChosenTerm>& acting) {
  const double usual = usual_wander * white, least = 0.25 * usual;
  const Wander before = p.problem.wander();
  SelectionProblem tried = p;
  const auto probability = [&](const Wander& wander) {
    take(tried, wander);
    const Selection fit = fit_terms(tried, acting);
    const double occam = fit.fit.covariance.ldlt().vectorD().array().log().sum();
    return (occam - fit.objective) / 2 + log_prior_of(wander, usual);
  };
  Wander best = before;
  double most = probability(before);
  const auto better = [&](const Wander& wander) {
    const double here = probability(wander);
    if (!(here > most)) return false;
    most = here, best = wander;
    return true;
  };
  Wander next = before;
  while (next.deviation > 0) {
    constexpr double between_steps = 1.5;  // of factors of two
    next.deviation = next.deviation > between_steps * least ? next.deviation / 2 : 0;
    better(next);
  }
  if (best.deviation == before.deviation) {
    next = before;
    do next.deviation = std::max(2 * next.deviation, least);
    while (better(next));
  }
  if (best.deviation == before.deviation) return false;
  take(p, best);
  fit_terms(p, acting);
  return true;
}

}  // namespace shakedown
