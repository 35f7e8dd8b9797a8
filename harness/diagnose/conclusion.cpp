// SPDX-License-Identifier: MIT
#include "conclusion.hpp"

#include <algorithm>
#include <cmath>

#include "candidates.hpp"
#include "distributions.hpp"
#include "errors.hpp"
#include "free_restitution.hpp"
#include "grain_count.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "known_to_errors.hpp"
#include "last_fit.hpp"
#include "next_experiment.hpp"
#include "quantity.hpp"
#include "rules.hpp"
#include "sentences.hpp"
#include "setup_file.hpp"
#include "unlisted_force.hpp"

namespace shakedown {

namespace {

/// Widens the interval of a fitted strength by what the engines differ by in its effect, because data may be
/// of either engine's kind. Where an effect has several strengths, each gets the largest of their
/// uncertainties, because the engines may differ in any one.
void allow_for_engines(FittedValue& value, const Knob& knob, const Refit& fit, const DiagnoseOptions& options,
                       std::vector<std::string>& notes) {
  const std::string effect(effect_of(value.key));
  const double relative = options.strength_uncertainty ? options.strength_uncertainty(effect) : 0;
  if (relative == 0) return;
  double strongest = 0;
  for (std::size_t k = 0; k < fit.values.size(); ++k)
    if (effect_of(fit.values[k].key) == effect)
      strongest = std::max(strongest, std::abs(fit.values[k].value - fit.knobs[k].absent));
  const double more = normal_95 * relative * strongest;
  value.low = std::max(knob.low, value.value - std::hypot(value.value - value.low, more));
  value.high = std::min(knob.high, value.value + std::hypot(value.high - value.value, more));
  const std::string note =
      "the interval of " + effect + " allows for " + write_number(std::round(100 * relative)) +
      " % by which hard impulses and soft contacts differ in it (shakedown effects " + effect + ")";
  // One note stands for all the strengths of an effect.
  if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

/// Takes the value from the balance where that found this strength, which it knows better than any ensemble.
/// Returns whether it did.
bool take_from_balance(const MomentumAudit& balance, FittedValue& value) {
  for (const FoundTerm& term : balance.terms)
    if (term.frequency == 0 && term.key() == value.key) {
      value.value = term.value, value.low = term.low, value.high = term.high;
      return true;
    }
  return false;
}

void set_parameters(const DiagnosisState& final, const DiagnosisTools& tools, Diagnosis& d) {
  for (std::size_t k = 0; k < final.fit.values.size(); ++k) {
    if (final.fit.knobs[k].exact) continue;
    FittedValue value = final.fit.values[k];
    if (value.at_bound) {
      d.notes.push_back(value.key + " would go beyond what is possible (" + write_number(value.value) +
                        "): the measurements do not tell it");
      continue;
    }
    const bool found = std::any_of(final.found.begin(), final.found.end(),
                                   [&](const Knob& knob) { return knob.key == value.key; });
    if (!take_from_balance(d.momentum, value) && found)
      allow_for_engines(value, final.fit.knobs[k], final.fit, tools.options(), d.notes);
    for (const std::string& key : joined_keys(value.key)) {
      d.parameters.push_back(
          {key, value.value, value.low, value.high, si_unit_of_key(key, tools.known()), ""});
      set_number(d.amended, key, value.value, tools.known());
    }
  }
}

void note_shape(const std::string& effect, const EffectRecord& record, const SearchedShape& shape,
                Diagnosis& d, KnownEffects known) {
  const std::string unit(record.find(shape.parameter)->unit);
  const double fitted = get_number(d.amended, effect + "." + std::string(shape.parameter), known);
  std::string others;
  for (const double value : shape.values)
    if (value != fitted) others += (others.empty() ? "" : ", ") + write_quantity(value, unit);
  const bool is_fitted = !d.promised || d.promised->effect != effect;
  d.notes.push_back(effect + (is_fitted ? " was fitted with " : " is given with ") +
                    std::string(shape.parameter) + " = " + write_quantity(fitted, unit) +
                    "; it was looked for with " + others + " too");
}

/// Notes which of the shapes that were tried each effect was fitted with: no strength tells it.
void note_shapes(Diagnosis& d, KnownEffects known) {
  for (const std::string& effect : d.missing) {
    const EffectRecord* record = known.find(effect);
    if (record == nullptr || !has_shapes(*record)) continue;
    for (const SearchedShape& shape : record->search.shapes) note_shape(effect, *record, shape, d, known);
  }
}

/// Fills in what ensembles and balance say of the camera; where both see a number, the one that knows it
/// better.
void set_camera(const Refit& fit, Diagnosis& d, KnownEffects known) {
  d.camera = d.momentum.nuisances;
  for (const NuisanceFound& found : nuisances_of(fit, known)) {
    const auto same = std::find_if(d.camera.begin(), d.camera.end(),
                                   [&](const NuisanceFound& n) { return n.name == found.name; });
    if (same == d.camera.end())
      d.camera.push_back(found);
    else if (found.error < same->error)
      *same = found;
  }
}

/// Advises half the grains: the two restitutions act together in a full box; with fewer grains the walls
/// matter more.
std::string fewer_grains(const Setup& user, const FittedValue& value) {
  return "N = " + std::to_string(user.grains.count / 2) +
         ": tells the two restitutions apart, which these runs know only together (" + value.key + " +- " +
         write_number(std::round(value.error * 1e3) / 1e3) + ")";
}

/// Advises to count the grains again where another number closes the balance as well: a grain too many or too
/// few moves as much mass as a bias of the camera or a heavier blade seems to.
void advise_to_count(const Setup& user, DiagnosisTools& tools, Diagnosis& d) {
  const int difference =
      miscount_in_question(grain_counts(tools.measurement(), tools.known(), d.momentum), d.momentum);
  if (difference == 0) return;
  const std::string instead =
      std::to_string(user.grains.count + difference) + " instead of " + std::to_string(user.grains.count);
  std::string as_well;
  for (const FoundTerm& term : d.momentum.terms) as_well += (as_well.empty() ? "" : " + ") + term.effect;
  d.next_experiments.push_back("count the grains again: " + instead + " close the momentum balance " +
                               (as_well.empty() ? "better" : "as well as " + as_well));
}

void advise_by_words(const Setup& user, const DiagnosisState& final, bool refitted, Diagnosis& d) {
  std::vector<std::string>& list = d.next_experiments;
  if (user.grains.count > 0) {
    for (const FoundTerm& term : d.momentum.terms)
      if (!term.look_alikes.empty())
        list.push_back("the box alone, grains.count = 0, ringing down: tells " + term.effect + " from " +
                       term.look_alikes.front() + " without any grains");
    if (d.verdict == Verdict::unknown && d.force_formula.empty())
      list.push_back(
          "the same box with half the grains and with none: what stays acts on the box, what goes lies in "
          "the "
          "contacts");
    else if (d.verdict == Verdict::unknown && !has_force_on_grains(d.amended))
      list.push_back(
          "the box alone, grains.count = 0, ringing down: shows whether the force acts on the box or on the "
          "grains");
  }
  for (const NuisanceFound& nuisance : standing_out(d.camera)) {
    list.push_back(nuisance.name.starts_with("box.") || nuisance.name.starts_with("grains.")
                       ? "weigh again: " + nuisance.name
                       : "film a ruler along the track, and the box at rest before release: " +
                             nuisance.name);
    break;
  }
  constexpr double badly_known = 0.03;  // of a restitution: what a drop test betters
  for (const FittedValue& value : final.fit.values)
    if (refitted && !d.promised && value.key.starts_with("restitution") && value.error > badly_known) {
      list.push_back(fewer_grains(user, value));
      break;
    }
}

/// Advises the experiments that would tell the effect added last from its rival.
void advise_by_simulation(const DiagnosisState& final, DiagnosisTools& tools, Diagnosis& d) {
  const RunnerUp& rival = d.runner_up;
  if (d.verdict != Verdict::missing || d.promised || rival.effect.empty() ||
      std::find(d.missing.begin(), d.missing.end(), rival.added) == d.missing.end())
    return;
  tools.begin("which experiment would decide");
  FittedModel found = fitted_model(d.amended, final.fit);
  found.setup.hard = final.setup.hard, found.setup.soft = final.setup.soft;
  const RunAudit& camera = tools.measurement().runs.front().audit;
  const int count = final.dear ? 32 : 64;
  std::vector<Advice> list;
  try {
    list = advise(possible_designs(d.amended, tools.features(final.setup)), found, rival.setup,
                  {camera.box.standard_deviation, camera.com.standard_deviation, count, tools.next_batch()},
                  tools.workshop());
  } catch (const BudgetSpent&) {
    d.not_tried.push_back("which experiment would decide");
  } catch (const PhysicsError& error) {
    d.notes.push_back(std::string("which experiment would decide could not be simulated: ") + error.what());
  }
  constexpr std::size_t most_told = 4;
  for (const Advice& advice : list)
    if (d.next_experiments.size() < most_told && advice.sigmas > 1)
      d.next_experiments.push_back(advice.words + ": tells " + rival.added + " from " + rival.effect +
                                   " at " + write_number(std::round(advice.sigmas * 10) / 10) +
                                   " sigma a run");
}

}  // namespace

void set_formula(Diagnosis& d) {
  if (d.momentum.formulas.empty()) return;
  UnlistedForce force = sum_of(d.momentum.formulas);
  if (has_force_on_grains(d.amended)) force = shared_by_grains(force, d.amended.grains.count).value_or(force);
  d.force_formula = as_table(force);
  for (const std::string& alike : d.momentum.formulas.front().look_alikes)
    d.notes.push_back("the force could as well be " + alike);
}

void complete_ranking(Diagnosis& d) {
  for (const FoundTerm& term : d.momentum.terms)
    d.ranking.push_back(
        {term.effect, term.gain, std::nan(""), std::nan(""), term.value, term.look_alikes, true, true});
  const auto place = [&](const RankedEffect& ranked) {
    return std::find(d.missing.begin(), d.missing.end(), ranked.effect) - d.missing.begin();
  };
  std::stable_sort(d.ranking.begin(), d.ranking.end(), [&](const RankedEffect& a, const RankedEffect& b) {
    return place(a) != place(b) ? place(a) < place(b) : a.gain > b.gain;
  });
}

namespace {

/// Returns the effects that there was no time for: those that are named in not_tried and, where no round was
/// held, all of the table. What was fitted was looked at, in whichever of its shapes; so was what the balance
/// weighs.
LeftOutEffects left_out_of(const Diagnosis& d, const std::vector<std::string>& found) {
  const auto in_ranking = [&](const std::string& effect, bool fitted) {
    return std::any_of(d.ranking.begin(), d.ranking.end(), [&](const RankedEffect& ranked) {
      return ranked.effect == effect && (ranked.fitted || !fitted);
    });
  };
  const auto in_balance = [&](const std::string& effect) {
    return std::any_of(d.momentum.seen.begin(), d.momentum.seen.end(),
                       [&](const std::string& key) { return key.starts_with(effect + "."); });
  };
  LeftOutEffects left_out;
  for (const std::string& step : d.not_tried)
    if (!in_ranking(step, true))
      (in_ranking(step, false) ? left_out.not_fitted : left_out.not_looked_at).push_back(step);
  if (contains(d.not_tried, no_round_held))
    for (const Hypothesis& h : d.hypotheses)
      for (const std::string& effect : h.effects)
        if (!in_ranking(effect, true) && !in_balance(effect) && !contains(left_out.not_fitted, effect) &&
            !contains(left_out.not_looked_at, effect))
          (in_ranking(effect, false) ? left_out.not_beside : left_out.not_looked_at).push_back(effect);
  left_out.found = found;
  return left_out;
}

}  // namespace

void settle_hypotheses(Diagnosis& d, const Findings& findings) {
  // Where a formula closes the balance and no set of known strengths does, odds are those of the two fits.
  const double something_else = findings.unlisted ? 1 / (1 + std::exp(-d.momentum.unlisted_log_odds))
                                                  : probability_of_something_else(worst_p_value(findings));
  const LeftOutEffects left_out = left_out_of(d, findings.found);  // which reads the table
  d.hypotheses = findings.unlisted
                     ? with_something_else(std::move(d.hypotheses), something_else, d.missing)
                     : with_something_else_or(left_out, std::move(d.hypotheses), something_else, d.missing);
  constexpr double shown = 0.99;
  double sum = 0;
  std::size_t count = 0;
  while (count < d.hypotheses.size() && sum < shown) sum += d.hypotheses[count++].probability;
  d.answers = answer_set(d.hypotheses);
  d.hypotheses.resize(count);
}

namespace {

/// Sets the restitutions back to what the user gave: they were fitted in a model without what is missing, and
/// may have imitated it.
void take_restitutions_back(const Setup& user, Diagnosis& d, KnownEffects known) {
  const auto is_restitution = [](const DiagnosedParameter& parameter) {
    return parameter.name.starts_with("restitution.");
  };
  if (std::none_of(d.parameters.begin(), d.parameters.end(), is_restitution)) return;
  for (const DiagnosedParameter& parameter : d.parameters)
    if (is_restitution(parameter))
      set_number(d.amended, parameter.name, get_number(user, parameter.name, known), known);
  if (d.last_fit) {
    auto last = std::make_shared<LastFit>(*d.last_fit);
    for (const DiagnosedParameter& parameter : d.parameters)
      if (is_restitution(parameter)) last->taken_back.push_back(parameter.name);
    d.last_fit = std::move(last);
  }
  std::erase_if(d.parameters, is_restitution);
  d.notes.push_back("the restitutions are as given: they were fitted without " + d.promised->effect);
}

bool names_promised(const Diagnosis& d, const std::vector<std::string>& found) {
  if (!d.promised || d.verdict != Verdict::unknown || d.momentum.unlisted || d.momentum.unexplained ||
      d.hypotheses.empty() || !(d.hypotheses.front().probability > rules::adds_effect))
    return false;
  // The hypothesis must be what was found and the promised effect: one with something that was taken back
  // since is not the answer's model.
  std::vector<std::string> with = found;
  with.push_back(d.promised->effect);
  const std::vector<std::string>& effects = d.hypotheses.front().effects;
  return std::is_permutation(effects.begin(), effects.end(), with.begin(), with.end());
}

}  // namespace

void name_promised(const Setup& user, const std::vector<std::string>& found, Diagnosis& d,
                   KnownEffects known) {
  if (!names_promised(d, found)) {
    d.promised.reset();
    return;
  }
  d.verdict = Verdict::missing;
  d.missing = d.hypotheses.front().effects;
  take_restitutions_back(user, d, known);
  for (const auto& [key, value] : d.promised->besides) set_number(d.amended, key, value, known);
  for (const DiagnosedParameter& strength : d.promised->strengths) {
    set_number(d.amended, strength.name, strength.value, known);
    d.parameters.push_back(strength);
  }
}

void conclude(const Setup& user, const DiagnosisState& given, const DiagnosisState& final, bool refitted,
              DiagnosisTools& tools, Diagnosis& d) {
  d.missing = final.missing;
  d.amended = final.setup;
  d.amended.hard = user.hard, d.amended.soft = user.soft;
  d.last_fit = std::make_shared<const LastFit>(LastFit{
      tools.measurement(), EnsembleFit{final.setup, tools.features(final.setup), given.fit, final.fit}, {}});
  d.explained = 1 - final.fit.chi2 / given.fit.chi2;
  if (!std::isfinite(d.explained)) d.explained = 0;
  set_camera(final.fit, d, tools.known());
  Findings findings;
  findings.unlisted = d.momentum.unlisted;
  findings.found = final.missing;
  findings.anything_missing = !d.missing.empty();
  findings.refitted = refitted || final.setup.release.packing != user.release.packing;
  findings.camera_stands_out = !standing_out(d.camera).empty();
  findings.explained = share_taken_away(given.fit.scatter, final.fit.scatter);
  findings.features = final.fit.test();
  findings.far_p_value = final.fit.far_p_value;
  findings.balance = d.momentum.test_of(d.momentum.final_fit);
  findings.left = final.fit.left();
  for (Difference& one : findings.left) one.amplitude = std::abs(user.release.displacement);
  if (refitted) compare_with_given(given.fit.validation(), final.fit.validation(), findings.left.front());
  d.left = findings.left;
  d.judgement = judgement_of(findings.features, findings.balance, findings.left);
  d.validation = final.fit.validation();
  d.verdict = verdict_of(findings);
  if (d.verdict == Verdict::adequate || !refitted) {
    d.ladder.resize(1);
    note_failures(given.fit, d);
  }
  if (d.verdict == Verdict::unknown) {
    // Known effects found beside a formula stay named.
    if (!d.momentum.unlisted) d.missing.clear();
    set_formula(d);
  }
  if (refitted) set_parameters(final, tools, d);
  complete_ranking(d);
  settle_hypotheses(d, findings);
  name_promised(user, final.missing, d, tools.known());
  if (d.judgement.standing == Standing::fails && !d.momentum.unlisted && !d.momentum.unexplained &&
      !d.promised)
    offer_free_restitution(user, final, tools, d);
  note_shapes(d, tools.known());
  d.sentence = sentence_of(d, tools.known());
  advise_to_count(user, tools, d);
  advise_by_words(user, final, refitted, d);
  advise_by_simulation(final, tools, d);
}

}  // namespace shakedown
