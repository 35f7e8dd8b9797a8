// SPDX-License-Identifier: MIT
// Goes from the momentum balance to a refitted model, and from there to the answer.
#include "course.hpp"

#include <algorithm>
#include <cmath>

#include "camera_features.hpp"
#include "empty_box.hpp"
#include "engine_choice.hpp"
#include "experiment.hpp"
#include "from_balance.hpp"
#include "in_order.hpp"
#include "packing_choice.hpp"
#include "parameter_knobs.hpp"
#include "quantity.hpp"
#include "rules.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "steady_forcing.hpp"
#include "swing.hpp"
#include "unlisted_force.hpp"
#include "verdict.hpp"

namespace shakedown {

namespace {

/// Makes the engines less exact: ensembles see no difference up to here, and low restitutions, drag on grains
/// and contacts that last cost several times less. Of 66 grains in boxes of 53 and 110 mm the first eight
/// peaks of 24 runs with 50, 20, 12 and 8 steps a contact are the same to 0.2 mm, their spread.
Setup quick(Setup setup) {
  constexpr double steps_per_contact = 10;
  setup.soft.steps_per_contact = std::min(setup.soft.steps_per_contact, steps_per_contact);
  constexpr double elastic_speed = 1e-2, kick_interval = 1e-2;  // m/s, s
  setup.hard.pair_elastic_speed = std::max(setup.hard.pair_elastic_speed, elastic_speed);
  setup.hard.kick_interval = std::max(setup.hard.kick_interval, kick_interval);
  return setup;
}

Setup emptied(Setup setup) {
  setup.grains.count = 0;
  return setup;
}

/// Returns what the balance tells of the shutter; nothing where the balance does not hold.
std::optional<ValueWithError> shutter_found(const MomentumAudit& balance, KnownEffects known) {
  if (!balance.possible || !(balance.final_fit.p_value > balance_rejected)) return std::nullopt;
  for (const NuisanceFound& one : balance.nuisances)
    if (one.name == known.key_of(&Camera::shutter)) return ValueWithError{one.value, one.error};
  return std::nullopt;
}

}  // namespace

Diagnosis Course::run() {
  result_.notes = all_notes(tools_.measurement());
  tools_.begin("momentum balance");
  MomentumOptions balance;
  balance.effects = tools_.options().effects;
  balance.formulas = allowed(tools_.options(), formula_effect_name);
  balance.out_of_time = [this] { return tools_.time_is_up(); };
  if (is_empty(user_, tools_.measurement())) {
    judge_empty_box(balance);
  } else {
    result_.momentum = audit_momentum(recorded_, tools_.known(), balance);
    tools_.set_wander(result_.momentum.wander_of_tracks());
    judge();
  }
  compare_forced_runs();
  result_.engine = tools_.workshop().engine->name();
  result_.runs_simulated = tools_.runs();
  return result_;
}

void Course::compare_forced_runs() {
  const bool shaken = std::any_of(recorded_.runs.begin(), recorded_.runs.end(),
                                  [](const Measurement::Run& run) { return is_shaken(run.setup); });
  if (!shaken || tools_.time_is_up()) return;
  constexpr int runs = 8;  // the spread is told to a quarter of itself
  const Measurement beside = with_setup(recorded_, result_.amended, tools_.known());
  try {
    for (DecayComparison& one : compare_decay(beside, tools_.workshop(), runs, tools_.next_batch()))
      if (one.forced) result_.forced.push_back(std::move(one));
  } catch (const Interrupted&) {
    // What was found by then is the answer.
  } catch (const PhysicsError& error) {
    result_.notes.push_back(std::string("the forced runs could not be simulated: ") + error.what());
  }
}

void Course::judge_empty_box(const MomentumOptions& whole) {
  MomentumOptions known_terms = whole;
  known_terms.formulas = false;
  result_.momentum = audit_momentum(recorded_, tools_.known(), known_terms);
  const Engine& engine = *tools_.workshop().engine;
  Diagnosis by_waveform = result_;
  const EffectsInQuestion asked{tools_.known(), tools_.options().effects,
                                threads_or_all(tools_.options().execution.threads)};
  if (conclude_by_waveform(emptied(user_), recorded_, engine, asked, by_waveform) &&
      by_waveform.verdict != Verdict::unknown) {
    result_ = std::move(by_waveform);
    return;
  }
  if (whole.formulas) result_.momentum = audit_momentum(recorded_, tools_.known(), whole);
  conclude_empty_box(emptied(user_), recorded_, engine, tools_.known(), by_waveform, result_);
}

void Course::judge() {
  DiagnosisState state = with_engine(with_packing());
  tools_.limit_to(std::max(share::model_as_given / 2, tools_.share_spent() + share::errors_of_the_damper));
  state = unless_spent(damper_weighed, state, [&] {
    DiagnosisState weighed = state;
    weighed.camera = together(state.camera, tools_.weigh_damper(state.setup));
    return weighed;
  });
  const DiagnosisState given = compared_as_given(state);
  state.scatter_at_start = given.fit.scatter;
  const MomentumAudit& balance = result_.momentum;
  const bool balance_holds =
      !balance.possible || (balance.terms.empty() && balance.refitted.p_value > balance_rejected);
  result_.hypotheses = hypotheses_of(balance);
  const bool accepted = given.fit.p_value > rules::doubtful && balance_holds;
  if (accepted && given.fit.p_value > rules::holds_well) {
    keep_priors(given);
    return conclude(user_, given, given, false, tools_, result_);
  }
  DiagnosisState refitted = refit_of(state);
  result_.ladder.push_back(step_of(
      step_name(refitted.missing) + (balance.unlisted ? " + the force of the formula" : ""), refitted.fit));
  // Beside a force that is known by its trace alone nothing else can be told for sure.
  DiagnosisState final = refitted;
  if (balance.unlisted)
    final = with_the_force_on_its_body(beside(refitted));
  else
    final = search(refitted);
  if (refitted.missing.empty() && !balance.unlisted) note_failures(refitted.fit, result_);
  if (final.missing.empty() && accepted) return conclude(user_, given, given, false, tools_, result_);
  if (!final.missing.empty() && final.missing != refitted.missing &&
      !explains(final.fit.p_value, final.fit.scatter, refitted.fit.scatter, final.fit.error_box(),
                final.fit.floor_box())) {
    take_back_others(final.missing, refitted.missing);
    final = refitted;
    result_.ladder.push_back(step_of(step_name(final.missing) + ", the rest taken back", final.fit));
  }
  // What the balance found was refitted with full effort already.
  tools_.limit_to(1);
  if (!final.missing.empty() && final.missing != refitted.missing && final.missing != wholly_fitted_)
    final = with_full_effort(final);
  // A fit with full effort tells strengths better than the one that weighed both of a pair.
  if (final.missing != refitted.missing && added_last_ > 1) {
    const DiagnosisState less = still_needed(final, added_last_);
    if (less.missing != final.missing) final = with_full_effort(less);
  }
  final = without_untold(std::move(final), refitted);
  if (final.missing.empty() && accepted) return conclude(user_, given, given, false, tools_, result_);
  conclude(user_, given, final, true, tools_, result_);
}

DiagnosisState Course::compared_as_given(const DiagnosisState& state) {
  DiagnosisState given = state;
  given.theta = as_given(state.setup, tools_.measurement().known, tools_.known());
  tools_.workshop().store.recordings = tools_.options().ensembles;
  given.fit = fit_within(share::model_as_given, given, "the model as given", effort::least);
  if (!is_far_off(given.fit))
    given.fit = fit_within(share::model_as_given, given, "the model as given", effort::look);
  tools_.workshop().store.recordings = nullptr;
  tools_.limit_to(rules::for_the_search);
  result_.ladder.push_back(step_of("as given", given.fit));
  note_failures(given.fit, result_);
  return given;
}

DiagnosisState Course::with_packing() {
  DiagnosisState state;
  state.setup = quick(user_);
  state.camera = camera_knobs(state.setup, tools_.measurement(), tools_.known(),
                              shutter_found(result_.momentum, tools_.known()));
  const auto [packing, apart, fits] = packing_before_release(user_, tools_.measurement(), tools_.known());
  if (!fits)
    result_.notes.push_back(
        "before release the grains' centre lies " + write_quantity(std::round(apart * 1e4) / 1e4, "mm") +
        " from where any packing has it: how the grains lay is unknown, and what acts on the first strokes "
        "alone may be that; give the runs their own initial_grains");
  if (packing == user_.release.packing) return state;
  state.setup.release.packing = packing;
  result_.parameters.push_back({"release.packing", 0, 0, 0, "", std::string(shakedown::name_of(packing))});
  result_.notes.push_back("before release the grains' centre lies where packing '" +
                          std::string(shakedown::name_of(packing)) + "' has it, not '" +
                          std::string(shakedown::name_of(user_.release.packing)) + "'");
  return state;
}

DiagnosisState Course::with_engine(DiagnosisState state) {
  const std::shared_ptr<const Engine>& lasting = tools_.options().lasting_contacts;
  const EngineChoice choice =
      chosen_engine(with_what_was_found(state, result_.momentum.terms, frequency_found()), tools_);
  if (choice.lasting_contacts) tools_.workshop().engine = lasting.get();
  first_periods_ = choice.fit;
  if (!choice.note.empty()) result_.notes.push_back(choice.note);
  state.dear = lasting != nullptr && tools_.workshop().engine->name() == lasting->name();
  return state;
}

double Course::frequency_found() const {
  const MomentumAudit& balance = result_.momentum;
  return balance.possible && balance.frequency > 0 ? balance.frequency : user_.spring.frequency;
}

DiagnosisState Course::with_terms(DiagnosisState state, const std::vector<FoundTerm>& terms,
                                  double frequency) {
  const MomentumAudit& balance = result_.momentum;
  state.theta = free_parameters(state.setup, frequency, (balance.possible ? 0.004 : 0.01) * frequency);
  state.theta = believed(std::move(state.theta), tools_.measurement().known, tools_.known());
  state.before_fits = state.theta;
  state = with_balance(state, terms, tools_.measurement(), *tools_.workshop().engine, tools_.options(),
                       result_.notes);
  if (!first_periods_) return state;
  // A layer whose contacts last begins almost without chaos, so that over a box as wide as what is believed
  // its features are no line.
  const double scatter_at_start = state.scatter_at_start;
  state.fit = *first_periods_;
  state = state.settled(tools_.known());
  state.fit = {};
  state.scatter_at_start = scatter_at_start;  // of whole runs
  return state;
}

DiagnosisState Course::with_what_was_found(DiagnosisState state, const std::vector<FoundTerm>& terms,
                                           double frequency) {
  state = with_terms(std::move(state), terms, frequency);
  const MomentumAudit& balance = result_.momentum;
  if (balance.unlisted && allowed(tools_.options(), formula_effect_name))
    state.setup = with_force(state.setup, sum_of(balance.formulas), tools_.known());
  return state;
}

DiagnosisState Course::refit_of(const DiagnosisState& before) {
  const MomentumAudit& balance = result_.momentum;
  const double frequency = frequency_found();
  DiagnosisState state = with_what_was_found(before, balance.terms, frequency);
  const bool nothing_found = state.missing.empty() && !balance.unlisted;
  const std::string stage =
      nothing_found ? "refitting the parameters" : "refitting with what the momentum balance found";
  try {
    state.fit = fit_within(share::first_refit, state, stage, effort::refit);
  } catch (const PhysicsError& error) {
    if (state.found.empty() && !balance.unlisted) throw;
    result_.notes.push_back(std::string("with what the momentum balance found the model cannot be simulated, "
                                        "so that ensembles are fitted without it: ") +
                            error.what());
    const std::vector<std::string> found = state.missing;
    state = with_terms(before, {}, frequency);
    state.missing = found;
    state.fit = fit_within(share::first_refit, state, stage, effort::look);
  }
  tools_.limit_to(rules::for_the_search);
  return settled_by_ensembles(before, state).settled(tools_.known());
}

Refit Course::fit_within(double share, const DiagnosisState& state, const std::string& stage, Effort effort) {
  tools_.limit_to(share);
  try {
    return tools_.fit(state, stage, state.knobs(), effort);
  } catch (const BudgetSpent&) {
    tools_.without_limit();
    return tools_.fit(state, stage, state.knobs(), effort::least);
  }
}

/// The balance tells the sum of forces on box and grains; where the model with the box's fails, that with the
/// grains' may hold.
DiagnosisState Course::with_the_force_on_its_body(const DiagnosisState& on_box) {
  if (!is_rejected(on_box.fit) || !allowed(tools_.options(), formula_effect_name)) return on_box;
  const std::optional<UnlistedForce> shared =
      shared_by_grains(sum_of(result_.momentum.formulas), on_box.setup.grains.count);
  if (!shared) return on_box;
  DiagnosisState on_grains = on_box;
  on_grains.setup = with_force(on_box.setup, *shared, tools_.known());
  try {
    on_grains.fit = tools_.fit(on_grains, "refitting with the force on the grains", on_grains.knobs(),
                               effort::refit, &on_box.fit);
  } catch (const BudgetSpent&) {
    leave_out("the force of the formula on the grains");
    return on_box;
  } catch (const PhysicsError& error) {
    result_.notes.push_back(std::string("with the force on the grains the model cannot be simulated: ") +
                            error.what());
    return on_box;
  }
  if (on_grains.fit.judged_chi2 > on_box.fit.own_chi2 - 2 * rules::emulator_noise) return on_box;
  result_.ladder.push_back(
      step_of(step_name(on_grains.missing) + " + the force of the formula on the grains", on_grains.fit));
  return on_grains.settled(tools_.known());
}

DiagnosisState Course::settled_by_ensembles(const DiagnosisState& before, const DiagnosisState& found) {
  MomentumAudit& balance = result_.momentum;
  if (balance.unlisted || !is_rejected(found.fit)) return found;
  DiagnosisState best = found;
  double most = 0;
  const BalanceAlternative* kept = nullptr;
  for (const BalanceAlternative& alternative : balance.alternatives) {
    DiagnosisState other = with_terms(before, alternative.terms, alternative.frequency);
    try {
      other.fit = tools_.fit(other, "refitting with what else the momentum balance allows", other.knobs(),
                             effort::attempt, &found.fit);
    } catch (const BudgetSpent&) {
      leave_out("what else the momentum balance allows");
      break;
    } catch (const PhysicsError& error) {
      result_.notes.push_back(std::string("a set that the momentum balance allows cannot be simulated: ") +
                              error.what());
      continue;
    }
    const double log_odds = alternative.log_odds + (found.fit.own_chi2 - other.fit.judged_chi2) / 2;
    if (log_odds > most) most = log_odds, best = other, kept = &alternative;
  }
  if (kept == nullptr) return found;
  const BalanceAlternative chosen = *kept;
  balance.terms = chosen.terms;
  balance.frequency = chosen.frequency;
  balance.frequency_low = chosen.frequency_low, balance.frequency_high = chosen.frequency_high;
  balance.final_fit = chosen.final_fit;
  balance.unexplained = chosen.final_fit.p_value <= balance_rejected;
  std::vector<std::string> effects;
  for (const FoundTerm& term : chosen.terms) effects.push_back(term.effect);
  result_.hypotheses = {{effects, 0, 1}};
  return best;
}

bool is_empty(const Setup& setup, const Measurement& measurement) {
  const auto has_none = [](const Measurement::Run& run) { return run.setup.grains.count == 0; };
  return setup.grains.count == 0 || (!measurement.runs.empty() &&
                                     std::all_of(measurement.runs.begin(), measurement.runs.end(), has_none));
}

std::string step_name(const std::vector<std::string>& effects) {
  std::string step = "refitted";
  for (const std::string& effect : effects) step += " + " + effect;
  return step;
}

}  // namespace shakedown
