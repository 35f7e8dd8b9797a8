// SPDX-License-Identifier: MIT
#include "balance_evidence.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "balance_rules.hpp"

namespace shakedown {

namespace {

constexpr std::size_t most_in_a_set = 4;

bool is_chosen(const std::vector<ChosenTerm>& chosen, int term) {
  return std::any_of(chosen.begin(), chosen.end(), [&](const ChosenTerm& c) { return c.term == term; });
}

/// Returns the fitted forces, run by run, whose derivatives carry the noise of positions into the balance.
std::vector<ForceSamples> fitted_forces(const SelectionProblem& p, const Selection& selection) {
  std::vector<ForceSamples> fitted(p.runs->size());
  for (std::size_t run = 0; run < p.runs->size(); ++run) {
    Eigen::Index column = 0;
    for (const ChosenTerm& c : selection.chosen) {
      if (c.term >= 0)  // a force in time alone carries no noise
        add_samples(fitted[run], p.terms[static_cast<std::size_t>(c.term)].samples[run],
                    selection.fit.strength[column]);
      column += width_of(c);
    }
  }
  return fitted;
}

/// Derives the chosen strengths again at the values just fitted, because some are not quite linear.
void derive_again(SelectionProblem& p, const Selection& selection) {
  Eigen::Index column = 0;
  for (const ChosenTerm& c : selection.chosen) {
    const double strength = selection.fit.strength[column];
    column += width_of(c);
    if (!p.is_known(c.term) || c.term == 0) continue;
    const MomentumTerm& term = p.known[static_cast<std::size_t>(c.term)];
    if (term.possible(strength) && strength != 0)
      p.terms[static_cast<std::size_t>(c.term)].samples = p.derive(term, strength);
  }
}

/// Returns the ln density of a strength beforehand: Cauchy about none with the typical strength as scale, so
/// that one thirty times as strong is unlikely and not impossible.
double log_prior(double strength, double typical, bool one_sided) {
  const double ratio = strength / typical;
  return std::log((one_sided ? 2 : 1) / (std::numbers::pi * typical * (1 + ratio * ratio)));
}

/// Holds what the frequency, the sines and the nuisances cannot take up.
struct Projected {
  std::vector<int> term;    ///< of the columns
  Eigen::MatrixXd gram;     ///< of the columns
  Eigen::VectorXd overlap;  ///< with the impulses
  double chi2 = 0, log_determinant = 0;
};

/// Returns where a term's column goes: at the end, or in the place of the same strength with another shape,
/// of which the one that gains most alone is weighed.
std::ptrdiff_t place_of(const SelectionProblem& p, const std::vector<int>& terms, int term) {
  const std::string& shape = p.known[static_cast<std::size_t>(term)].shape;
  return std::find_if(terms.begin(), terms.end(),
                      [&](int other) {
                        return !shape.empty() && p.known[static_cast<std::size_t>(other)].shape == shape;
                      }) -
         terms.begin();
}

Projected projected(const SelectionProblem& p, const std::vector<ChosenTerm>& base) {
  const Eigen::MatrixXd free = columns_of(p, base);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(free);
  const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(free.rows(), free.cols());
  const auto outside = [&](const Eigen::MatrixXd& columns) -> Eigen::MatrixXd {
    const Eigen::MatrixXd once = columns - basis * (basis.transpose() * columns);
    return once - basis * (basis.transpose() * once);
  };
  Projected out;
  const Eigen::VectorXd impulse = outside(p.problem.impulse());
  out.chi2 = impulse.squaredNorm();
  out.log_determinant = 2 * qr.matrixQR().diagonal().cwiseAbs().array().max(1e-300).log().sum();
  Eigen::MatrixXd columns(impulse.size(), std::ssize(p.known));
  for (int term = 1; p.is_known(term); ++term) {
    if (is_chosen(base, term)) continue;
    const Eigen::VectorXd column = p.problem.column(p.terms[static_cast<std::size_t>(term)]);
    const Eigen::VectorXd left = outside(column);
    // What leaves no trace, or merely scales what is left (a camera's scale), is not seen here.
    const double along = left.dot(impulse) / std::max(out.chi2, 1e-300);
    constexpr double a_trace = 1e-6;  // of the column's square: a thousandth of the column
    if (!((left - along * impulse).squaredNorm() > a_trace * column.squaredNorm())) continue;
    const std::ptrdiff_t place = place_of(p, out.term, term);
    const auto gain = [&](const auto& one) { return std::pow(one.dot(impulse), 2) / one.squaredNorm(); };
    if (place == std::ssize(out.term))
      out.term.push_back(term);
    else if (gain(left) > gain(columns.col(place)))
      out.term[static_cast<std::size_t>(place)] = term;
    else
      continue;
    columns.col(place) = left;
  }
  columns.conservativeResize(Eigen::NoChange, std::ssize(out.term));
  out.gram = columns.transpose() * columns;
  out.overlap = columns.transpose() * impulse;
  return out;
}

/// Visits every way to choose up to `most` of n, each in ascending order.
void each_set(std::size_t n, std::size_t most, std::vector<std::size_t>& set,
              const std::function<void(const std::vector<std::size_t>&)>& visit) {
  if (!set.empty()) visit(set);
  if (set.size() == most) return;
  for (std::size_t next = set.empty() ? 0 : set.back() + 1; next < n; ++next) {
    set.push_back(next);
    each_set(n, most, set, visit);
    set.pop_back();
  }
}

double prior_odds(const SelectionProblem& p, double odds) {
  const double each = expected_effects * odds / static_cast<double>(p.known.size());
  return std::log(each / (1 - each));
}

/// Tells whether the set has two frictions that turn with the motion. These are one joint seen twice: of a
/// yielding and a dry one any travel between could be mixed.
bool rubs_twice(const SelectionProblem& p, const Projected& q, const std::vector<std::size_t>& set) {
  return std::count_if(set.begin(), set.end(),
                       [&](std::size_t i) { return p.known[static_cast<std::size_t>(q.term[i])].dry; }) > 1;
}

/// Returns ln odds of a set over nothing; -infinity where a strength has the wrong sign or is out of its
/// bounds, or where two terms do the same. Sets `gain`.
double log_odds_of(const SelectionProblem& p, const Projected& q, const std::vector<std::size_t>& set,
                   double& gain) {
  constexpr double impossible = -std::numeric_limits<double>::infinity();
  if (rubs_twice(p, q, set)) return impossible;
  const auto n = std::ssize(set);
  Eigen::MatrixXd gram(n, n);
  Eigen::VectorXd overlap(n), scale(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const auto i = static_cast<Eigen::Index>(set[static_cast<std::size_t>(a)]);
    scale[a] = 1 / std::sqrt(q.gram(i, i));
  }
  for (Eigen::Index a = 0; a < n; ++a) {
    const auto i = static_cast<Eigen::Index>(set[static_cast<std::size_t>(a)]);
    overlap[a] = q.overlap[i] * scale[a];
    for (Eigen::Index b = 0; b < n; ++b)
      gram(a, b) =
          q.gram(i, static_cast<Eigen::Index>(set[static_cast<std::size_t>(b)])) * scale[a] * scale[b];
  }
  const Eigen::LLT<Eigen::MatrixXd> root(gram);
  constexpr double apart = 1e-4;  // sine of the angle between a column of length 1 and those before it
  if (root.info() != Eigen::Success || root.matrixLLT().diagonal().minCoeff() < apart) return impossible;
  const Eigen::VectorXd scaled = root.solve(overlap);
  gain = overlap.dot(scaled);
  double sum = gain / 2;
  for (Eigen::Index a = 0; a < n; ++a) {
    const MomentumTerm& term = p.known[static_cast<std::size_t>(q.term[set[static_cast<std::size_t>(a)]])];
    const double strength = scaled[a] * scale[a];
    if ((term.never_negative && strength <= 0) || !term.possible(strength)) return impossible;
    // A strength known worse than the prior takes nothing of it away.
    sum += std::min(0.0, log_prior(strength, term.typical, term.never_negative) +
                             std::log(2 * std::numbers::pi) / 2 + std::log(scale[a]) -
                             std::log(root.matrixLLT()(a, a))) +
           prior_odds(p, term.odds);
  }
  return sum;
}

double log_sum(const std::vector<double>& logs) {
  const double most = *std::max_element(logs.begin(), logs.end());
  double sum = 0;
  for (const double one : logs) sum += std::exp(one - most);
  return most + std::log(sum);
}

std::vector<BalanceHypothesis> by_probability(std::vector<BalanceHypothesis> list) {
  std::vector<double> odds;
  for (const BalanceHypothesis& hypothesis : list) odds.push_back(hypothesis.log_odds);
  const double all = log_sum(odds);
  for (BalanceHypothesis& hypothesis : list) hypothesis.probability = std::exp(hypothesis.log_odds - all);
  std::stable_sort(list.begin(), list.end(), [](const BalanceHypothesis& a, const BalanceHypothesis& b) {
    return a.log_odds > b.log_odds;
  });
  return list;
}

std::vector<BalanceHypothesis> sets_of(const SelectionProblem& p, const Projected& q,
                                       const std::vector<ChosenTerm>& base, std::size_t most) {
  std::vector<BalanceHypothesis> list{{base, 0, 0, 0}};
  std::vector<std::size_t> set;
  each_set(q.term.size(), most, set, [&](const std::vector<std::size_t>& chosen) {
    double gain = 0;
    const double odds = log_odds_of(p, q, chosen, gain);
    if (!std::isfinite(odds)) return;
    BalanceHypothesis hypothesis{base, odds, gain, 0};
    for (const std::size_t i : chosen) hypothesis.chosen.push_back({q.term[i], 0});
    list.push_back(std::move(hypothesis));
  });
  return list;
}

}  // namespace

bool is_part_of(const std::vector<ChosenTerm>& part, const std::vector<ChosenTerm>& whole) {
  return std::all_of(part.begin(), part.end(), [&](const ChosenTerm& c) {
    return std::any_of(whole.begin(), whole.end(),
                       [&](const ChosenTerm& w) { return w.term == c.term && w.frequency == c.frequency; });
  });
}

Eigen::MatrixXd columns_of(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen) {
  const Eigen::MatrixXd& nuisances = p.problem.nuisance_columns();
  Eigen::Index count = nuisances.cols();
  for (const ChosenTerm& c : chosen) count += width_of(c);
  Eigen::MatrixXd columns(p.problem.size(), count);
  Eigen::Index column = 0;
  for (const ChosenTerm& c : chosen) {
    if (c.term < 0)
      columns.middleCols(column, 2) = p.problem.harmonic(c.frequency);
    else
      columns.col(column) = p.problem.column(p.terms[static_cast<std::size_t>(c.term)]);
    column += width_of(c);
  }
  columns.rightCols(nuisances.cols()) = nuisances;
  return columns;
}

Selection fit_terms(SelectionProblem& p, std::vector<ChosenTerm> chosen) {
  Selection selection{std::move(chosen), {}, 0};
  constexpr int iterations = 3;  // an assumption: noise and strengths follow each other
  for (int iteration = 0; iteration < iterations; ++iteration) {
    selection.fit = regress(p.problem.impulse(), columns_of(p, selection.chosen));
    if (iteration > 0) derive_again(p, selection);
    p.problem.set_covariance(fitted_forces(p, selection));
  }
  selection.fit = regress(p.problem.impulse(), columns_of(p, selection.chosen));
  selection.objective = selection.fit.chi2 + p.problem.noise_penalty();
  return selection;
}

std::vector<BalanceHypothesis> compare_sets(const SelectionProblem& p, const std::vector<ChosenTerm>& base) {
  return by_probability(sets_of(p, projected(p, base), base, most_in_a_set));
}

std::vector<BalanceHypothesis> with_own_noise(const SelectionProblem& p,
                                              const std::vector<BalanceHypothesis>& sets) {
  constexpr std::size_t most = 8;
  std::vector<BalanceHypothesis> list;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const bool in_question = i < most && sets[i].log_odds > sets.front().log_odds - hopeless_log_odds;
    if (!in_question && !is_part_of(sets[i].chosen, sets.front().chosen)) continue;
    SelectionProblem own = p;
    const Selection fit = fit_terms(own, sets[i].chosen);
    BalanceHypothesis hypothesis = sets[i];
    hypothesis.log_odds += -hypothesis.gain / 2 - fit.objective / 2;
    list.push_back(std::move(hypothesis));
  }
  return by_probability(std::move(list));
}

std::vector<int> terms_seen(const SelectionProblem& p) { return projected(p, {{0, 0}}).term; }

double log_evidence_of_noise(const SelectionProblem& p) {
  constexpr std::size_t most = 2;  // what acts is hardly ever more, and the noise is weighed fifty times
  const std::vector<ChosenTerm> base{{0, 0}};
  const Projected q = projected(p, base);
  std::vector<double> odds;
  for (const BalanceHypothesis& hypothesis : sets_of(p, q, base, most)) odds.push_back(hypothesis.log_odds);
  return log_sum(odds) - (q.chi2 + q.log_determinant + p.problem.noise_penalty()) / 2;
}

SineFound best_sine(const SelectionProblem& p, const Selection& beside, double lowest, double highest) {
  const Eigen::MatrixXd basis = orthonormal_basis(columns_of(p, beside.chosen));
  const Eigen::VectorXd residual = p.problem.impulse() - basis * (basis.transpose() * p.problem.impulse());
  const double step = 0.25 / std::max(p.problem.longest(), 1.0);
  const double resolved =
      3 / std::max(p.problem.longest(), 1.0);  // Hz: three beats in a recording, an assumption
  for (std::size_t run = 0; run < p.problem.runs(); ++run)
    highest = std::min(highest, 0.2 / p.problem.form(run).run().interval);
  struct Seen {
    double gain = 0, log_odds = -std::numeric_limits<double>::infinity();
  };
  const auto seen_at = [&](double frequency) -> Seen {
    Eigen::MatrixXd pair = p.problem.harmonic(frequency);
    pair -= basis * (basis.transpose() * pair);
    const Eigen::Matrix2d normal = pair.transpose() * pair;
    constexpr double rounding = 1e-12;
    if (!(normal.determinant() > rounding * normal(0, 0) * normal(1, 1))) return {};
    const Eigen::Vector2d right = pair.transpose() * residual, both = normal.inverse() * right;
    const double gain = right.dot(both), amplitude = both.norm();
    // The prior is half-Cauchy in the amplitude, with any phase.
    return {gain, gain / 2 + log_prior(amplitude, p.typical_sine, true) -
                      std::log(std::max(amplitude, 1e-300)) - std::log(normal.determinant()) / 2};
  };
  SineFound best{0, -std::numeric_limits<double>::infinity()};
  double most = 0;
  std::vector<double> odds;
  for (double frequency = lowest; frequency <= highest; frequency += step) {
    // Two sines closer than the recording can resolve make any transient between them; the swing of an empty
    // box is one of the two.
    const auto near = [&](double other) { return std::abs(other - frequency) < resolved; };
    if (std::any_of(beside.chosen.begin(), beside.chosen.end(),
                    [&](const ChosenTerm& c) { return c.term < 0 && near(c.frequency); }) ||
        std::any_of(p.runs->begin(), p.runs->end(), [&](const MomentumRun& run) {
          return run.grain_mass == 0 && run.box_mass > 0 &&
                 near(std::sqrt(run.stiffness / run.box_mass) / (2 * std::numbers::pi));
        }))
      continue;
    const Seen seen = seen_at(frequency);
    odds.push_back(seen.log_odds);
    if (seen.gain > most) most = seen.gain, best.frequency = frequency;
  }
  if (odds.empty() || most == 0) return best;
  for (double width = step / 2; width > step / 500; width /= 2)
    for (const double frequency : {best.frequency - width, best.frequency + width})
      if (const Seen seen = seen_at(frequency); seen.gain > most)
        most = seen.gain, best.frequency = frequency;
  best.log_odds = log_sum(odds) - std::log(static_cast<double>(odds.size())) + prior_odds(p, 1);
  return best;
}

Gain gain_of_term(const SelectionProblem& p, const Selection& selection, int term) {
  std::vector<ChosenTerm> others;
  for (const ChosenTerm& c : selection.chosen)
    if (c.term != term) others.push_back(c);
  const Eigen::MatrixXd columns = columns_of(p, others);
  const PreparedTerm& prepared = p.terms[static_cast<std::size_t>(term)];
  return gain_of(regress(p.problem.impulse(), columns).residual, orthonormal_basis(columns),
                 p.problem.column(prepared), prepared.never_negative);
}

}  // namespace shakedown
