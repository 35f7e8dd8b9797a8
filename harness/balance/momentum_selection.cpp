// SPDX-License-Identifier: MIT
#include "momentum_selection.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace shakedown {

namespace {

constexpr double price_of_a_term = 6;  // beside ln n: about 4e-4 false alarms a term

/// Lines beyond are formulas.
bool is_known(int term) { return term < static_cast<int>(momentum_terms().size()); }

bool is_chosen(const std::vector<ChosenTerm>& chosen, int term) {
  return std::any_of(chosen.begin(), chosen.end(), [&](const ChosenTerm& c) { return c.term == term; });
}

/// The fitted forces, run by run, whose derivatives carry the noise of positions into the balance.
std::vector<ForceSamples> fitted_forces(const SelectionProblem& p, const Selection& selection) {
  std::vector<ForceSamples> fitted(p.runs->size());
  for (std::size_t run = 0; run < p.runs->size(); ++run) {
    Eigen::Index column = 0;
    for (const ChosenTerm& c : selection.chosen) {
      if (c.term < 0)
        column += 2;  // a force in time alone carries no noise
      else {
        const ForceSamples& samples = p.terms[static_cast<std::size_t>(c.term)].samples[run];
        add_samples(fitted[run], samples, selection.fit.strength[column++]);
      }
    }
  }
  return fitted;
}

/// Terms that are not quite linear are taken at the strength just fitted.
void bend_terms(SelectionProblem& p, const Selection& selection) {
  Eigen::Index column = 0;
  for (const ChosenTerm& c : selection.chosen) {
    const double strength = selection.fit.strength[column];
    column += c.term < 0 ? 2 : 1;
    if (c.term < 0 || !is_known(c.term) || momentum_terms()[static_cast<std::size_t>(c.term)].linear)
      continue;
    for (std::size_t run = 0; run < p.runs->size(); ++run)
      if ((*p.runs)[run].time.size())
        p.terms[static_cast<std::size_t>(c.term)].samples[run] =
            momentum_terms()[static_cast<std::size_t>(c.term)].samples((*p.runs)[run], strength);
  }
}

struct Candidate {
  ChosenTerm term;
  double gain = 0;
  double price = 0;
  double surplus() const { return gain - price; }
};

/// The frequency at which a sine gains most.
Candidate best_sine(const SelectionProblem& p, const Selection& selection, const Eigen::MatrixXd& basis,
                    double lowest, double highest) {
  const Eigen::VectorXd& residual = selection.fit.residual;
  double longest = 0;
  for (std::size_t run = 0; run < p.problem.runs(); ++run)
    longest =
        std::max(longest, p.problem.form(run).run().time.tail(1)[0] - p.problem.form(run).run().time[0]);
  const double n = static_cast<double>(p.problem.size());
  const double step = 0.25 / std::max(longest, 1.0);
  for (std::size_t run = 0; run < p.problem.runs(); ++run)
    highest = std::min(highest, 0.2 / p.problem.form(run).run().interval);
  if (highest <= lowest) return {};
  const auto trials = static_cast<int>((highest - lowest) / step) + 1;
  const auto gain_at = [&](double frequency) {
    Eigen::MatrixXd pair = p.problem.harmonic(frequency);
    pair -= basis * (basis.transpose() * pair);
    const Eigen::Matrix2d normal = pair.transpose() * pair;
    if (!(normal.determinant() > 1e-12 * normal(0, 0) * normal(1, 1))) return 0.0;
    const Eigen::Vector2d right = pair.transpose() * residual;
    return right.dot(normal.inverse() * right);
  };
  Candidate best;
  for (int i = 0; i < trials; ++i) {
    const double frequency = lowest + step * i;
    // Two sines closer than the recording can resolve make any transient between them.
    if (std::any_of(selection.chosen.begin(), selection.chosen.end(), [&](const ChosenTerm& c) {
          return c.term < 0 && std::abs(c.frequency - frequency) < 12 * step;
        }))
      continue;
    const double gain = gain_at(frequency);
    if (gain > best.gain) best = {{-1, frequency}, gain, 0};
  }
  for (double width = step / 2; width > step / 500; width /= 2)
    for (const double frequency : {best.term.frequency - width, best.term.frequency + width})
      if (const double gain = gain_at(frequency); gain > best.gain) best = {{-1, frequency}, gain, 0};
  best.price = 2 * std::log(n) + price_of_a_term + 2 * std::log(std::max(trials, 1));
  return best;
}

int sines_in(const Selection& selection) {
  return static_cast<int>(std::count_if(selection.chosen.begin(), selection.chosen.end(),
                                        [](const ChosenTerm& c) { return c.term < 0; }));
}

Candidate best_candidate(const SelectionProblem& p, const Selection& selection,
                         const MomentumOptions& options) {
  const Eigen::MatrixXd basis = orthonormal_basis(columns_of(p, selection.chosen));
  const double price = std::log(static_cast<double>(p.problem.size())) + price_of_a_term;
  Candidate best;
  if (sines_in(selection) < options.most_sines)
    best = best_sine(p, selection, basis, options.lowest_frequency,
                     std::min(options.highest_frequency, p.highest_frequency));
  for (int term = 0; is_known(term); ++term) {
    if (is_chosen(selection.chosen, term)) continue;
    const PreparedTerm& prepared = p.terms[static_cast<std::size_t>(term)];
    const Gain gain =
        gain_of(selection.fit.residual, basis, p.problem.column(prepared), prepared.never_negative);
    if (const Candidate c{{term, 0}, gain.gain, price}; c.surplus() > best.surplus()) best = c;
  }
  return best;
}

/// Replaces a term by another when that fits clearly better; the first choice of a forward selection is often
/// a look-alike.
bool swap_terms(SelectionProblem& p, Selection& selection) {
  for (std::size_t out = 1; out < selection.chosen.size(); ++out) {
    if (selection.chosen[out].term < 0) continue;
    for (int term = 1; is_known(term); ++term) {
      if (is_chosen(selection.chosen, term)) continue;
      std::vector<ChosenTerm> others = selection.chosen;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(out));
      const Eigen::MatrixXd columns = columns_of(p, others);
      const Regression without = regress(p.problem.impulse(), columns);
      const PreparedTerm& prepared = p.terms[static_cast<std::size_t>(term)];
      const Gain gain = gain_of(without.residual, orthonormal_basis(columns), p.problem.column(prepared),
                                prepared.never_negative);
      if (gain.gain == 0 || without.chi2 - gain.gain > selection.fit.chi2 - 2) continue;
      const double before = selection.objective;
      std::vector<ChosenTerm> swapped = selection.chosen;
      swapped[out] = {term, 0};
      Selection trial = fit_terms(p, swapped);
      if (trial.objective < before - 2) {
        selection = std::move(trial);
        return true;
      }
      selection = fit_terms(p, selection.chosen);  // the covariance must follow the fit that stays
    }
  }
  return false;
}

}  // namespace

SelectionProblem selection_problem(const std::vector<MomentumRun>& runs, double frequency,
                                   const MomentumOptions& options) {
  const double window = options.window_periods / frequency;
  // Above 1.2/T a window averages a sine away to less than half.
  SelectionProblem p{MomentumProblem(runs, window, window * options.hop), {}, &runs, 1.2 / window};
  for (const MomentumTerm& term : momentum_terms()) {
    const bool there = std::any_of(runs.begin(), runs.end(), [&](const MomentumRun& run) {
      return std::find(run.effects.begin(), run.effects.end(), term.effect) != run.effects.end();
    });
    PreparedTerm prepared{term.effect, term.never_negative && !there, {}};
    for (const MomentumRun& run : runs)
      prepared.samples.push_back(run.time.size() ? term.samples(run, 0) : ForceSamples{});
    p.terms.push_back(std::move(prepared));
  }
  return p;
}

Eigen::MatrixXd columns_of(const SelectionProblem& p, const std::vector<ChosenTerm>& chosen) {
  Eigen::Index count = 0;
  for (const ChosenTerm& c : chosen) count += c.term < 0 ? 2 : 1;
  Eigen::MatrixXd columns(p.problem.size(), count);
  Eigen::Index column = 0;
  for (const ChosenTerm& c : chosen) {
    if (c.term < 0) {
      columns.middleCols(column, 2) = p.problem.harmonic(c.frequency);
      column += 2;
    } else {
      columns.col(column++) = p.problem.column(p.terms[static_cast<std::size_t>(c.term)]);
    }
  }
  return columns;
}

Selection fit_terms(SelectionProblem& p, std::vector<ChosenTerm> chosen) {
  Selection selection{std::move(chosen), {}, 0};
  const bool bent = std::any_of(selection.chosen.begin(), selection.chosen.end(), [](const ChosenTerm& c) {
    return c.term >= 0 && is_known(c.term) && !momentum_terms()[static_cast<std::size_t>(c.term)].linear;
  });
  for (int iteration = 0; iteration < (bent ? 4 : 2); ++iteration) {
    selection.fit = regress(p.problem.impulse(), columns_of(p, selection.chosen));
    if (bent) bend_terms(p, selection);
    p.problem.set_covariance(fitted_forces(p, selection));
  }
  selection.fit = regress(p.problem.impulse(), columns_of(p, selection.chosen));
  selection.objective = selection.fit.chi2 + p.problem.noise_penalty();
  return selection;
}

bool drop_needless(SelectionProblem& p, Selection& selection) {
  const double bits = std::log(static_cast<double>(p.problem.size()));
  Eigen::Index column = 1;
  for (std::size_t out = 1; out < selection.chosen.size(); ++out) {
    const ChosenTerm c = selection.chosen[out];
    const bool sine = c.term < 0;
    double gain = 0;
    for (const Eigen::Index last = column + (sine ? 2 : 1); column < last; ++column)
      gain += std::pow(selection.fit.strength[column] / std::max(selection.fit.error[column], 1e-300), 2);
    const bool forbidden = !sine && p.terms[static_cast<std::size_t>(c.term)].never_negative &&
                           selection.fit.strength[column - 1] < 0;
    // When the balance is not closed the noise is not the whole error.
    const double error = std::max(1.0, selection.fit.chi2 / selection.fit.degrees);
    if (gain > error * ((sine ? 2 : 1) * bits + price_of_a_term) && !forbidden) continue;
    selection.chosen.erase(selection.chosen.begin() + static_cast<std::ptrdiff_t>(out));
    selection = fit_terms(p, selection.chosen);
    return true;
  }
  return false;
}

std::optional<KnownCandidate> best_known(const SelectionProblem& p, const Selection& selection,
                                         const MomentumOptions& options) {
  const Candidate best = best_candidate(p, selection, options);
  if (best.gain == 0) return std::nullopt;
  return KnownCandidate{best.term, best.surplus()};
}

Selection select_terms(SelectionProblem& p, const MomentumOptions& options) {
  Selection selection = fit_terms(p, {{0, 0}});
  for (int added = 0; added < options.most_terms; ++added) {
    const Candidate best = best_candidate(p, selection, options);
    if (best.surplus() <= 0) break;
    std::vector<ChosenTerm> chosen = selection.chosen;
    chosen.push_back(best.term);
    selection = fit_terms(p, chosen);
    for (int change = 0; change < 6 && (swap_terms(p, selection) || drop_needless(p, selection)); ++change) {
    }
  }
  return selection;
}

std::optional<FastSine> find_fast_sine(SelectionProblem& shorter, const std::vector<ChosenTerm>& chosen,
                                       double lowest, double highest) {
  Selection selection = fit_terms(shorter, chosen);
  const Candidate best = best_sine(shorter, selection, orthonormal_basis(columns_of(shorter, chosen)), lowest,
                                   std::min(highest, shorter.highest_frequency));
  if (best.surplus() <= 0) return std::nullopt;
  selection.chosen.push_back(best.term);
  selection = fit_terms(shorter, selection.chosen);
  const Eigen::Index last = selection.fit.strength.size() - 2;
  return FastSine{best.term.frequency, selection.fit.strength[last], selection.fit.strength[last + 1],
                  selection.fit.error.segment(last, 2).maxCoeff()};
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
