// SPDX-License-Identifier: MIT
#include "shape_found.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shakedown {

namespace {

double& shape_of(MomentumTerm& term) {
  return std::find_if(term.besides.begin(), term.besides.end(),
                      [&](const auto& beside) { return beside.first == term.shape; })
      ->second;
}

/// Returns ln of the step to the nearest other value that is tried; 0 where there is none.
double step_to_next(SelectionProblem& p, MomentumTerm& term) {
  double step = 0;
  for (MomentumTerm& other : p.known)
    if (other.shape == term.shape && shape_of(other) != shape_of(term)) {
      const double away = std::abs(std::log(shape_of(other) / shape_of(term)));
      step = step == 0 ? away : std::min(step, away);
    }
  return step;
}

}  // namespace

bool find_shapes(SelectionProblem& p, const std::vector<ChosenTerm>& chosen) {
  constexpr double precise = 0.02;
  bool moved = false;
  for (const ChosenTerm& c : chosen) {
    if (!p.is_known(c.term) || p.known[static_cast<std::size_t>(c.term)].shape.empty()) continue;
    MomentumTerm& term = p.known[static_cast<std::size_t>(c.term)];
    PreparedTerm& prepared = p.terms[static_cast<std::size_t>(c.term)];
    const auto take = [&](double shape) {
      shape_of(term) = shape;
      prepared.samples = p.derive(term, term.typical);
    };
    const double from = std::log(shape_of(term)), step = step_to_next(p, term);
    const auto misfit = [&](double log_shape) {
      take(std::exp(log_shape));
      return regress(p.problem.impulse(), columns_of(p, chosen)).chi2;
    };
    // Search by golden section.
    constexpr double golden = 1 / std::numbers::phi;
    double low = from - step, high = from + step;
    double left = high - golden * (high - low), right = low + golden * (high - low);
    double at_left = misfit(left), at_right = misfit(right);
    while (high - low > precise) {
      if (at_left < at_right) {
        high = right, right = left, at_right = at_left;
        at_left = misfit(left = high - golden * (high - low));
      } else {
        low = left, left = right, at_left = at_right;
        at_right = misfit(right = low + golden * (high - low));
      }
    }
    take(std::exp((low + high) / 2));
    moved = true;
  }
  return moved;
}

}  // namespace shakedown
