// SPDX-License-Identifier: MIT
#include "term_prices.hpp"

#include <algorithm>
#include <cmath>

namespace shakedown {

std::optional<KnownCandidate> best_known(const SelectionProblem& p, const Selection& selection) {
  const Eigen::MatrixXd basis = orthonormal_basis(columns_of(p, selection.chosen));
  const double price = std::log(static_cast<double>(p.problem.size())) + price_of_a_term;
  std::optional<KnownCandidate> best;
  // A camera's scale would merely shrink what is left.
  for (const int term : terms_seen(p)) {
    if (std::any_of(selection.chosen.begin(), selection.chosen.end(),
                    [&](const ChosenTerm& c) { return c.term == term; }))
      continue;
    const PreparedTerm& prepared = p.terms[static_cast<std::size_t>(term)];
    const Gain gain =
        gain_of(selection.fit.residual, basis, p.problem.column(prepared), prepared.never_negative);
    if (gain.gain > 0 && (term == 0 || p.known[static_cast<std::size_t>(term)].possible(gain.strength)) &&
        (!best || gain.gain - price > best->surplus))
      best = KnownCandidate{{term, 0}, gain.gain - price};
  }
  return best;
}

bool drop_needless(SelectionProblem& p, Selection& selection) {
  const double bits = std::log(static_cast<double>(p.problem.size()));
  Eigen::Index column = 1;
  for (std::size_t out = 1; out < selection.chosen.size(); ++out) {
    const ChosenTerm c = selection.chosen[out];
    double gain = 0;
    for (const Eigen::Index last = column + width_of(c); column < last; ++column)
      gain += std::pow(selection.fit.strength[column] / std::max(selection.fit.error[column], 1e-300), 2);
    const bool forbidden = c.term >= 0 && p.terms[static_cast<std::size_t>(c.term)].never_negative &&
                           selection.fit.strength[column - 1] < 0;
    // When the balance is not closed the noise is not the whole error.
    const double error = std::max(1.0, selection.fit.chi2 / selection.fit.degrees);
    if (gain > error * (static_cast<double>(width_of(c)) * bits + price_of_a_term) && !forbidden) continue;
    selection.chosen.erase(selection.chosen.begin() + static_cast<std::ptrdiff_t>(out));
    selection = fit_terms(p, selection.chosen);
    return true;
  }
  return false;
}

}  // namespace shakedown
