// SPDX-License-Identifier: MIT
#include "foretold.hpp"

#include <utility>

namespace shakedown {

namespace {

/// First row of a stretch, and number of its rows.
using FirstAndCount = std::pair<Eigen::Index, Eigen::Index>;

std::vector<FirstAndCount> stretches_of(const MomentumProblem& problem) {
  std::vector<FirstAndCount> stretches;
  for (std::size_t run = 0; run < problem.runs(); ++run)
    if (problem.rows(run) > 0) stretches.push_back({problem.begin(run), problem.rows(run)});
  if (stretches.size() != 1) return stretches;
  const auto [begin, rows] = stretches.front();
  return {{begin, rows / 2}, {begin + rows / 2, rows - rows / 2}};
}

}  // namespace

double chi2_foretold(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen) {
  const Eigen::MatrixXd columns = columns_of(p, chosen);
  const Eigen::VectorXd& impulse = p.problem.impulse();
  double chi2 = 0;
  for (const auto& [begin, rows] : stretches_of(p.problem)) {
    // Rows of zeros take no part; what is known beforehand of the nuisances stands in rows of its own below.
    Eigen::MatrixXd seen_columns = columns;
    Eigen::VectorXd seen = impulse;
    seen_columns.middleRows(begin, rows).setZero();
    seen.segment(begin, rows).setZero();
    const Eigen::VectorXd strength = regress(seen, seen_columns).strength;
    chi2 += (impulse.segment(begin, rows) - columns.middleRows(begin, rows) * strength).squaredNorm();
  }
  return chi2;
}

bool imitates_known(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen) {
  std::vector<ChosenTerm> others;
  for (const ChosenTerm& c : chosen)
    if (c.term < 0 || p.is_known(c.term)) others.push_back(c);
  if (others.size() == chosen.size()) return false;
  const Eigen::MatrixXd columns = columns_of(p, others);
  const Regression without = regress(p.problem.impulse(), columns);
  const double of_formulas = without.chi2 - regress(p.problem.impulse(), columns_of(p, chosen)).chi2;
  const Eigen::MatrixXd basis = orthonormal_basis(columns);
  double best = 0;
  for (int known = 1; p.is_known(known); ++known) {
    const MomentumTerm& term = p.known[static_cast<std::size_t>(known)];
    if (term.kind != TermKind::physics) continue;
    const PreparedTerm& prepared = p.terms[static_cast<std::size_t>(known)];
    const Gain gain = gain_of(without.residual, basis, p.problem.column(prepared), prepared.never_negative);
    if (term.possible(gain.strength)) best = std::max(best, gain.gain);
  }
  return best >= imitated * of_formulas;
}

}  // namespace shakedown
