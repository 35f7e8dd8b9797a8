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

namespace {

void take(SelectionProblem& p, const Wander& wander) {
  p.problem.set_wander(wander);
  p.problem.set_covariance({});
}

/// ln of a half-Cauchy prior, by the logarithm of the strength; memories are equally likely. None has what
/// lies below a quarter of the usual.
double log_prior_of(const Wander& wander, double usual) {
  if (wander.deviation == 0) return std::log(2 / std::numbers::pi * std::atan(0.25));
  const double ratio = wander.deviation / usual;
  return std::log(2 * std::numbers::ln2 / std::numbers::pi * ratio / (1 + ratio * ratio)) - std::log(3.0);
}

/// The most probable wander beside these terms; p is left with the last that was tried.
Wander best_wander(SelectionProblem& p, double usual, const std::vector<ChosenTerm>& beside) {
  const auto probability = [&](const Wander& wander) {
    take(p, wander);
    return log_evidence_of_noise(p, beside) + log_prior_of(wander, usual);
  };
  Wander best;
  double most = probability(best);
  for (const double time : {0.1, 0.3, 1.0}) {
    // Upwards from a quarter of the usual until it has fallen twice in a row.
    double last = -std::numeric_limits<double>::infinity();
    for (int step = 0, falls = 0; step < 14 && falls < 2; ++step) {
      const Wander wander{0.25 * usual * std::pow(2, step), time};
      const double here = probability(wander);
      falls = here < last ? falls + 1 : 0;
      last = here;
      if (here > most) most = here, best = wander;
    }
  }
  return best;
}

}  // namespace

void choose_wander(SelectionProblem& p, double white, const SineRange& sines) {
  const std::vector<ChosenTerm> spring{{0, 0}};
  const double usual = usual_wander * white;
  const Wander plain = best_wander(p, usual, spring);
  const auto sine = [&] { return best_sine(p, {spring, {}, 0}, sines.lowest, sines.highest); };
  take(p, plain);
  if (plain.deviation <= usual || !(p.typical_sine > 0)) return;
  const auto log_probability = [&](const Wander& wander) {
    take(p, wander);
    return log_evidence_of_noise(p, spring) + log_prior_of(wander, usual) + std::max(0.0, sine().log_odds);
  };
  take(p, {usual, plain.time});
  const SineFound seen = sine();
  const Wander beside = seen.log_odds > 0 ? best_wander(p, usual, {{0, 0}, {-1, seen.frequency}}) : plain;
  const bool less = beside.deviation < plain.deviation && log_probability(beside) > log_probability(plain);
  take(p, less ? beside : plain);
}

}  // namespace shakedown
