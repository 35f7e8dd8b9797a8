// SPDX-License-Identifier: MIT
#include "linear_audit.hpp"

#include <algorithm>
#include <cmath>

#include "balance_problem.hpp"
#include "balance_rules.hpp"
#include "distributions.hpp"
#include "effect_strength.hpp"
#include "force_formula.hpp"
#include "foretold.hpp"
#include "robust_statistics.hpp"
#include "sets_weighed.hpp"
#include "wander_choice.hpp"

namespace shakedown {

namespace {

/// chi2 by which a force that no list has must beat every set of known ones, beyond the prices of its
/// parameters: it is e^5 times less likely beforehand.
constexpr double price_of_the_unlisted = 10;
/// ln odds by which it must beat them besides: nine to one, with which known effects are added too
/// (rules::adds_effect of a diagnosis).
const double adds_the_unlisted = std::log(9.0);

/// Returns how good a fit is. The error of the noise's variance widens chi2 like so many degrees fewer.
BalanceFit balance_of(double chi2, double degrees) {
  if (!(degrees > 0) || std::isnan(chi2)) return {chi2, degrees, std::nan("")};
  const double effective = 2 / (2 / degrees + error_of_noise_variance * error_of_noise_variance);
  return {chi2, degrees, chi_squared_tail(chi2 * effective / degrees, effective)};
}
BalanceFit balance_of(const Regression& fit) { return balance_of(fit.chi2, fit.degrees); }

/// Returns how good a fit is in the rows of one run.
BalanceFit balance_of_run(const MomentumProblem& problem, std::size_t run, const Eigen::VectorXd& residual,
                          double fitted) {
  return balance_of(
      residual.segment(problem.begin(run), problem.rows(run)).squaredNorm(),
      static_cast<double>(problem.rows(run)) * (1 - fitted / static_cast<double>(problem.size())));
}

RunBalance run_as_given(const MomentumProblem& problem, std::size_t run) {
  RunBalance balance;
  balance.run = problem.run_name(run);
  balance.as_given = balance_of_run(problem, run, problem.impulse(), 0);
  if (problem.rows(run) == 0) return balance;  // the box of this run hardly moves
  const double weight = problem.form(run).weight();
  const Eigen::VectorXd deviation = problem.raw_deviation(run) / weight;
  const Eigen::VectorXd force = problem.raw_impulse(run) / weight;
  balance.missing_force_noise = deviation.mean();
  balance.missing_force = std::sqrt(
      std::max(0.0, (force.squaredNorm() - deviation.squaredNorm()) / static_cast<double>(force.size())));
  return balance;
}

/// Returns the effects that could stand in for this term: those of sets that are probable enough to be in
/// question and do without it.
std::vector<std::string> look_alikes(const SelectionProblem& p, const std::vector<BalanceHypothesis>& sets,
                                     const std::vector<ChosenTerm>& best, int which) {
  constexpr double in_question = 0.05;
  std::vector<std::string> names;
  for (const BalanceHypothesis& set : sets) {
    if (set.probability < in_question) continue;
    const auto has = [](const std::vector<ChosenTerm>& chosen, int term) {
      return std::any_of(chosen.begin(), chosen.end(), [&](const ChosenTerm& c) { return c.term == term; });
    };
    if (has(set.chosen, which)) continue;
    for (const ChosenTerm& c : set.chosen) {
      if (!p.is_known(c.term) || c.term == 0 || has(best, c.term)) continue;
      const std::string& name = p.known[static_cast<std::size_t>(c.term)].effect;
      if (name == p.known[static_cast<std::size_t>(which)].effect) continue;  // of another shape
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

std::string name_of_sine(KnownEffects known) {
  const std::vector<const EffectRecord*> oscillating = known.oscillating();
  return oscillating.empty() ? "" : std::string(oscillating.front()->name);
}

FoundTerm sine_found(KnownEffects known, double frequency, double sine, double cosine, double error) {
  FoundTerm found;
  if (const EffectRecord* record = known.find(name_of_sine(known))) {
    const std::string_view amplitude = record->search.harmonic->amplitude;  // of a vector a component
    const Parameter& parameter = *record->find(amplitude.substr(0, amplitude.find('.')));
    found.effect = record->name, found.parameter = parameter.name, found.unit = parameter.unit;
  }
  found.value = std::hypot(sine, cosine);
  found.low = std::max(0.0, found.value - normal_95 * error);
  found.high = found.value + normal_95 * error;
  found.frequency = frequency;
  found.phase = std::atan2(cosine, sine);
  found.gain = found.value * found.value / (error * error);
  return found;
}

/// Returns the factor that widens errors when the balance is not closed: then the noise is not the whole
/// error.
double widened(const Regression& fit) { return std::sqrt(std::max(1.0, fit.chi2 / fit.degrees)); }

FoundTerm term_found(const SelectionProblem& p, const Selection& selection, std::size_t which,
                     Eigen::Index column) {
  const MomentumTerm& term = p.known[static_cast<std::size_t>(selection.chosen[which].term)];
  FoundTerm found{term.effect, term.parameter, term.unit, term.kind};
  found.besides = term.besides;
  const double strength = selection.fit.strength[column],
               wide = normal_95 * selection.fit.error[column] * widened(selection.fit);
  found.value = term.parameter_at(strength);
  std::tie(found.low, found.high) =
      std::minmax({term.parameter_at(strength - wide), term.parameter_at(strength + wide)});
  found.gain = std::pow(strength / selection.fit.error[column], 2);
  return found;
}

std::vector<SingleTerm> ranking_of(const SelectionProblem& p, const Selection& refitted) {
  std::vector<SingleTerm> ranking;
  for (int term = 1; p.is_known(term); ++term) {
    const Gain gain = gain_of_term(p, refitted, term);
    if (gain.gain > 0)
      ranking.push_back({p.terms[static_cast<std::size_t>(term)].name, gain.gain, gain.strength, gain.error});
  }
  std::stable_sort(ranking.begin(), ranking.end(),
                   [](const SingleTerm& a, const SingleTerm& b) { return a.gain > b.gain; });
  // Keep the shape that gains most of each effect.
  for (auto one = ranking.begin(); one != ranking.end(); ++one)
    ranking.erase(std::remove_if(one + 1, ranking.end(),
                                 [&](const SingleTerm& other) { return other.effect == one->effect; }),
                  ranking.end());
  return ranking;
}

std::vector<WeighedSet> sets_in_words(const SelectionProblem& p, const std::vector<BalanceHypothesis>& list,
                                      KnownEffects known) {
  constexpr double shown = 0.99;
  std::vector<WeighedSet> sets;
  double sum = 0;
  for (const BalanceHypothesis& hypothesis : list) {
    WeighedSet set{{}, hypothesis.probability};
    for (const ChosenTerm& c : hypothesis.chosen) {
      if (c.term == 0) continue;
      const std::string name =
          c.term < 0 ? name_of_sine(known) : p.terms[static_cast<std::size_t>(c.term)].name;
      if (std::find(set.effects.begin(), set.effects.end(), name) == set.effects.end())
        set.effects.push_back(name);
    }
    const auto same = std::find_if(sets.begin(), sets.end(),
                                   [&](const WeighedSet& other) { return other.effects == set.effects; });
    if (same == sets.end())
      sets.push_back(std::move(set));
    else
      same->probability += set.probability;  // of another shape
    if ((sum += hypothesis.probability) > shown) break;
  }
  std::stable_sort(sets.begin(), sets.end(),
                   [](const WeighedSet& a, const WeighedSet& b) { return a.probability > b.probability; });
  return sets;
}

void describe_nuisances(const SelectionProblem& p, const Selection& selection, MomentumAudit& audit) {
  const auto& nuisances = p.problem.nuisances();
  const Eigen::Index first = selection.fit.strength.size() - std::ssize(nuisances);
  for (std::size_t k = 0; k < nuisances.size(); ++k) {
    const Eigen::Index column = first + static_cast<Eigen::Index>(k);
    const BalanceNuisance& nuisance = nuisances[k];
    audit.nuisances.push_back({nuisance.name, nuisance.unit, nuisance.deviation,
                               nuisance.already + selection.fit.strength[column] * nuisance.deviation,
                               selection.fit.error[column] * nuisance.deviation});
  }
}

template <typename Described>
void describe_frequency(const Selection& selection, double frequency, Described& audit) {
  const double spring = selection.fit.strength[0],
               wide = normal_95 * selection.fit.error[0] * widened(selection.fit);
  const auto at = [&](double stiffness) { return frequency * std::sqrt(std::max(0.0, 1 + stiffness)); };
  audit.frequency = at(spring);
  audit.frequency_low = at(spring - wide);
  audit.frequency_high = at(spring + wide);
}

/// Returns the rms over the windows of what is left, as a displacement of the spring, m. `selection`: what
/// was fitted; null: nothing.
double displacement_left(const SelectionProblem& p, const Selection* selection) {
  double sum = 0;
  for (std::size_t run = 0; run < p.problem.runs(); ++run) {
    Eigen::VectorXd left = p.problem.raw_impulse(run);
    Eigen::Index column = 0;
    if (selection)
      for (const ChosenTerm& c : selection->chosen) {
        left -=
            p.problem.raw_columns(
                run, c.term < 0 ? nullptr : &p.terms[static_cast<std::size_t>(c.term)].samples, c.frequency) *
            selection->fit.strength.segment(column, width_of(c));
        column += width_of(c);
      }
    const WeakForm& form = p.problem.form(run);
    sum += left.squaredNorm() / std::pow(form.weight() * form.run().stiffness, 2);
  }
  return std::sqrt(sum / static_cast<double>(std::max<Eigen::Index>(1, p.problem.windows())));
}

std::vector<FoundTerm> terms_found(const SelectionProblem& p, const Selection& selection,
                                   KnownEffects known) {
  std::vector<FoundTerm> found;
  Eigen::Index column = 1;
  for (std::size_t which = 1; which < selection.chosen.size(); ++which) {
    const ChosenTerm& c = selection.chosen[which];
    if (c.term < 0)
      found.push_back(sine_found(known, c.frequency, selection.fit.strength[column],
                                 selection.fit.strength[column + 1],
                                 selection.fit.error.segment(column, 2).maxCoeff()));
    else if (p.is_known(c.term))
      found.push_back(term_found(p, selection, which, column));
    column += width_of(c);
  }
  return found;
}

/// Returns sets that the balance finds less probable and cannot rule out: parts of the set found, which may
/// have too much in it, and what may stand in its place.
std::vector<BalanceAlternative> alternatives_of(const SelectionProblem& p,
                                                const std::vector<BalanceHypothesis>& sets, double frequency,
                                                KnownEffects known) {
  constexpr double in_question = 0.02;
  constexpr std::size_t most = 3;
  std::vector<BalanceAlternative> list;
  for (std::size_t i = 1; i < sets.size() && list.size() < most; ++i) {
    const double log_odds = sets[i].log_odds - sets.front().log_odds;
    const bool has_more = sets[i].chosen.size() > sets.front().chosen.size();
    const bool is_part = is_part_of(sets[i].chosen, sets.front().chosen);
    if (log_odds < -hopeless_log_odds || has_more || !(is_part || sets[i].probability > in_question))
      continue;
    SelectionProblem own = p;
    const Selection selection = fit_terms(own, sets[i].chosen);
    BalanceAlternative alternative{log_odds, terms_found(own, selection, known), 0, 0,
                                   0,        balance_of(selection.fit)};
    describe_frequency(selection, frequency, alternative);
    list.push_back(std::move(alternative));
  }
  return list;
}

void describe(const SelectionProblem& p, const Selection& selection,
              const std::vector<BalanceHypothesis>& sets, KnownEffects known, MomentumAudit& audit) {
  audit.final_fit = balance_of(selection.fit);
  audit.terms = terms_found(p, selection, known);
  Eigen::Index column = 1;
  std::size_t next = 0;
  for (std::size_t which = 1; which < selection.chosen.size(); ++which) {
    const ChosenTerm& c = selection.chosen[which];
    if (c.term >= 0 && p.is_known(c.term))
      audit.terms[next].look_alikes = look_alikes(p, sets, selection.chosen, c.term);
    if (c.term < 0 || p.is_known(c.term)) ++next;
    column += width_of(c);
  }
  for (std::size_t run = 0; run < p.problem.runs(); ++run)
    for (RunBalance& balance : audit.runs)
      if (balance.run == p.problem.run_name(run))
        balance.final_fit =
            balance_of_run(p.problem, run, selection.fit.residual, static_cast<double>(column));
  describe_nuisances(p, selection, audit);
  audit.wander = p.problem.wander();
  audit.rest = displacement_left(p, &selection);
  audit.rest_as_given = displacement_left(p, nullptr);
  audit.explained = 1 - selection.fit.chi2 / p.problem.impulse().squaredNorm();
}

/// Returns the ln odds of this set, no set's own noise counted.
double log_odds_over_nothing(const std::vector<BalanceHypothesis>& sets, const BalanceHypothesis& one) {
  const auto same = std::find_if(sets.begin(), sets.end(), [&](const BalanceHypothesis& other) {
    return std::equal(other.chosen.begin(), other.chosen.end(), one.chosen.begin(), one.chosen.end(),
                      [](const ChosenTerm& a, const ChosenTerm& b) {
                        return a.term == b.term && a.frequency == b.frequency;
                      });
  });
  return same == sets.end() ? one.gain / 2 : same->log_odds;
}

/// Tells whether something was found, or the balance is not in order, or the track wanders more than tracks
/// usually do.
bool is_in_doubt(const SelectionProblem& p, const Selection& selection, const MomentumOptions& options,
                 double usual) {
  return selection.chosen.size() > 1 || !(balance_of(selection.fit).p_value >= options.accept_p) ||
         p.problem.wander().deviation > usual;
}

/// Holds forces in no list beside the best set of known strengths.
struct FormulasTried {
  FormulaFit fit;
  double cost_of_known = 0;
  bool is_better = false;
};

/// Tries formulas beside the best known set, with the usual wander at most: a track that wanders more than
/// tracks do takes up any force. A formula that leaves the balance rejected, imitates a known force or
/// foretells nothing is no better than known forces.
FormulasTried formulas_beside(SelectionProblem p, const BalanceHypothesis& known, double usual) {
  p.problem.set_wander({std::min(usual, p.problem.wander().deviation), p.problem.wander().time});
  p.problem.set_covariance({});
  const double cost_of_known = cost_of(p, fit_terms(p, known.chosen));
  FormulasTried tried{fit_formulas(std::move(p)), cost_of_known};
  const FormulaFit& fit = tried.fit;
  tried.is_better =
      !fit.formulas.empty() && fit.cost < cost_of_known - price_of_the_unlisted - 2 * adds_the_unlisted &&
      balance_of(fit.selection.fit).p_value > balance_rejected &&
      !imitates_known(fit.problem, fit.selection.chosen) &&
      chi2_foretold(fit.problem, fit.selection.chosen) < chi2_foretold(fit.problem, known.chosen) - as_good;
  return tried;
}

/// Returns how good the balance is with frequency and nuisances alone, or with what the setup says of the
/// frequency.
BalanceFit without_effects(const SelectionProblem& p, bool free_frequency) {
  return balance_of(
      regress(p.problem.impulse(), free_frequency ? columns_of(p, {{0, 0}}) : p.problem.nuisance_columns()));
}

}  // namespace

void by_what_they_explain(std::vector<FoundTerm>& terms) {
  std::stable_sort(terms.begin(), terms.end(), [](const FoundTerm& a, const FoundTerm& b) {
    const bool a_sine = a.frequency > 0, b_sine = b.frequency > 0;
    return a_sine != b_sine ? b_sine : a.gain > b.gain;
  });
}

MomentumAudit linear_audit(const Measurement& measurement, KnownEffects known, const MomentumOptions& options,
                           const NuisanceValues& already) {
  MomentumAudit audit;
  const BalanceProblem balance(measurement, known, already, options.effects);
  std::optional<SetsWeighed> weighed = weigh_sets(balance, options);
  audit.possible = weighed.has_value();
  if (!audit.possible) {
    audit.why_not =
        "no run has the positions of the box, and of its grains if there are any, in frames close together "
        "over more than a few periods";
    return audit;
  }
  audit.only_moving = weighed->only_moving;
  SelectionProblem p = std::move(weighed->problem);
  p.problem.set_covariance({});  // the setup as it is lets in what its own forces do, no more
  for (std::size_t run = 0; run < p.problem.runs(); ++run) audit.runs.push_back(run_as_given(p.problem, run));
  audit.as_given = without_effects(p, false);
  audit.refitted = without_effects(p, true);
  audit.ranking = ranking_of(p, fit_terms(p, {{0, 0}}));
  const std::vector<BalanceHypothesis> sets = with_own_noise(p, weighed->sets);
  Selection selection = fit_terms(p, sets.front().chosen);
  audit.sets = sets_in_words(p, sets, known);
  audit.log_odds = log_odds_over_nothing(weighed->sets, sets.front());
  audit.alternatives = alternatives_of(p, sets, balance.frequency(), known);
  for (const int term : terms_seen(p)) audit.seen.push_back(p.known[static_cast<std::size_t>(term)].key());
  describe_frequency(selection, balance.frequency(), audit);
  const double usual = usual_wander * balance.noise();
  if (options.formulas && is_in_doubt(p, selection, options, usual) &&
      !(options.out_of_time && options.out_of_time())) {
    FormulasTried tried = formulas_beside(p, sets.front(), usual);
    audit.unlisted = tried.is_better;
    if (audit.unlisted || !(balance_of(selection.fit).p_value >= options.accept_p))
      audit.curves = std::move(tried.fit.curves);
    if (audit.unlisted) {
      audit.unlisted_log_odds = (tried.cost_of_known - price_of_the_unlisted - tried.fit.cost) / 2;
      audit.formulas = std::move(tried.fit.formulas);
      p = std::move(tried.fit.problem);
      selection = std::move(tried.fit.selection);
    }
  }
  describe(p, selection, sets, known, audit);
  audit.white_noise = balance.noise();
  audit.most_wander = most_wander(balance.runs(), balance.noise());
  if (options.formulas && !audit.unlisted && !audit.terms.empty()) {
    const std::vector<std::vector<std::string>> alike = formulas_like_known_terms(p, selection);
    for (std::size_t i = 0; i < audit.terms.size(); ++i)
      audit.terms[i].look_alikes.insert(audit.terms[i].look_alikes.end(), alike[i + 1].begin(),
                                        alike[i + 1].end());
  }
  by_what_they_explain(audit.terms);
  audit.unexplained = !(audit.final_fit.p_value > balance_rejected);
  return audit;
}

}  // namespace shakedown
