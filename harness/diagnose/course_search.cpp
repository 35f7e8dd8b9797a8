// SPDX-License-Identifier: MIT
// Searches for effects: in rounds beside the refitted model, with what their fits leave.
#include <algorithm>

#include "course.hpp"
#include "from_balance.hpp"
#include "known_effects.hpp"
#include "rules.hpp"

namespace shakedown {

namespace {

constexpr const char* last_refit = "the last refit";

/// Tells whether the round added an effect so probable that no better fit of the model without it would take
/// it back.
bool is_sure(const SearchRound& round) {
  return round.added && std::any_of(round.table.begin(), round.table.end(), [](const Hypothesis& h) {
           return !h.effects.empty() && h.log_odds > rules::emulator_noise;
         });
}

}  // namespace

DiagnosisState& Course::beside(DiagnosisState& refitted) {
  if (refitted.fit.p_value > rules::doubtful) return refitted;
  try {
    refitted.fit = tools_.look_beside(refitted, "looking beside the fitted parameters");
  } catch (const PhysicsError&) {  // the model cannot be simulated there: the fit stands
    return refitted;
  }
  refitted = refitted.settled(tools_.known());
  result_.ladder.back() = step_of(result_.ladder.back().step, refitted.fit);
  return refitted;
}

DiagnosisState Course::search(DiagnosisState& refitted) {
  DiagnosisState state = refitted;
  // Search until nothing is added, though the data accept the model: chi2 of hundreds of features does not
  // see what a single effect would take away. Where runs cost several times a plain one, search on only while
  // they do not.
  for (bool searched = false;; searched = true) {
    if (static_cast<double>(state.missing.size()) >= rules::most_effects) break;
    if (searched && state.dear && state.fit.p_value > rules::doubtful) break;
    SearchRound round;
    try {
      round = search_round(state, tools_, result_.momentum.seen);
    } catch (const BudgetSpent&) {
      leave_out(no_round_held);
      keep_priors(state);
      break;
    }
    if (!searched && state.fit.p_value <= rules::doubtful && !is_sure(round)) {
      const double before = state.fit.scatter * state.fit.degrees;
      state = beside(refitted);
      // Where it lies in another valley now, what was seen about the first one says little.
      if (state.fit.scatter * state.fit.degrees < before - rules::emulator_noise) try {
          SearchRound again = search_round(state, tools_, result_.momentum.seen);
          // One for which there was no time tells less than the first.
          if (again.added || again.not_tried.size() <= round.not_tried.size()) round = std::move(again);
        } catch (const BudgetSpent&) {  // what was found beside the poorer fit stands
        }
    }
    for (const std::string& effect : round.not_tried) leave_out(effect);
    for (const RankedEffect& ranked : round.ranking) keep_ranked(ranked);
    result_.notes.insert(result_.notes.end(), round.notes.begin(), round.notes.end());
    result_.hypotheses = combined(result_.hypotheses, round.table);
    result_.promised = round.promised;
    if (!round.added) break;
    accepted_.reset();
    if (state.fit.p_value > rules::holds) accepted_ = state;
    added_last_ = round.next.missing.size() - state.missing.size();
    state = round.next;
    runner_up_ = {round.next.missing.back(), round.runner_up, round.runner_up_setup};
    result_.ladder.push_back(step_of(step_name(state.missing), state.fit));
    state = still_needed(std::move(state), added_last_);
    // Make the fit of the end now, where it may spare a round.
    if (state.fit.p_value <= rules::doubtful) state = with_full_effort(state).settled(tools_.known());
  }
  result_.runner_up = runner_up_;
  return state;
}

DiagnosisState Course::still_needed(DiagnosisState state, std::size_t added) {
  const std::vector<std::string> before = state.missing;
  // A pair was weighed as a whole: to know that both are needed is worth what was kept for the last fit.
  const KeptLimit limit(tools_);
  if (added > 1) tools_.limit_to(1);
  state = unless_spent("which effects are still needed", state,
                       [&] { return pruned(state, tools_, effects_of(result_.momentum), added); });
  take_back_others(before, state.missing);
  if (state.missing.size() < before.size()) added_last_ = 1;
  return state;
}

DiagnosisState Course::with_full_effort(DiagnosisState state) {
  state = unless_spent(last_refit, state, [&] {
    DiagnosisState whole = concluded(state, tools_, "refitting with what was found");
    // Do not follow a fit that ended astray, as one of a model that is far off may.
    if ((whole.fit.scatter - state.fit.scatter) * state.fit.degrees > rules::emulator_noise) whole = state;
    wholly_fitted_ = state.missing;
    std::erase(result_.not_tried, last_refit);
    return whole;
  });
  if (result_.ladder.back().step == step_name(state.missing)) result_.ladder.pop_back();
  result_.ladder.push_back(step_of(step_name(state.missing), state.fit));
  return state;
}

DiagnosisState Course::without_untold(DiagnosisState state, const DiagnosisState& refitted) {
  // The evidence of the effect was of a fit with less effort. Intervals of what restitutions imitate are
  // wide, so that only a strength which is none for all purposes speaks against it (an assumption), or that
  // no error falls.
  constexpr double of_no_strength = 0.5;  // standard errors
  if (state.missing.empty() || state.missing == refitted.missing) return state;
  if (!accepted_)
    return adds_nothing(state.fit.p_value, refitted.fit.validation(), state.fit.validation())
               ? without_added(state, refitted)
               : state;
  const bool told = is_told(state.fit, state.missing.back(), of_no_strength);
  if (told && !no_error_falls(accepted_->fit.validation(), state.fit.validation())) return state;
  const std::string effect = state.missing.back();
  result_.notes.push_back(effect + " was taken back: the data accept the model without it, and " +
                          (told ? "no error falls with it" : "the last fit finds next to nothing of it"));
  take_back(effect);
  if (result_.ladder.back().step == step_name(state.missing)) result_.ladder.pop_back();
  state = *accepted_;
  if (state.missing == refitted.missing || state.missing == wholly_fitted_) return state;
  return with_full_effort(state);
}

DiagnosisState Course::without_added(const DiagnosisState& state, const DiagnosisState& refitted) {
  for (const std::string& effect : state.missing)
    if (!contains(refitted.missing, effect))
      result_.notes.push_back(
          effect + " was taken back: the data reject the model with it as well, and no error falls");
  take_back_others(state.missing, refitted.missing);
  while (result_.ladder.size() > 1 && result_.ladder.back().step != step_name(refitted.missing))
    result_.ladder.pop_back();
  return refitted;
}

void Course::take_back(const std::string& effect) {
  result_.hypotheses = taken_back(result_.hypotheses, effect,
                                  prior_log_odds(1, static_cast<double>(tools_.known().searched())));
}

void Course::take_back_others(const std::vector<std::string>& effects, const std::vector<std::string>& kept) {
  for (const std::string& effect : effects)
    if (!contains(kept, effect)) take_back(effect);
}

void Course::leave_out(const std::string& step) {
  std::vector<std::string>& list = result_.not_tried;
  if (std::find(list.begin(), list.end(), step) == list.end()) list.push_back(step);
}

void Course::keep_ranked(const RankedEffect& ranked) {
  const auto same = std::find_if(result_.ranking.begin(), result_.ranking.end(),
                                 [&](const RankedEffect& r) { return r.effect == ranked.effect; });
  if (same == result_.ranking.end())
    result_.ranking.push_back(ranked);
  else if (ranked.fitted && !same->fitted)
    *same = ranked;
}

void Course::keep_priors(const DiagnosisState& state) {
  result_.hypotheses = combined(result_.hypotheses, not_looked_at(state, tools_, result_.momentum.seen));
}

}  // namespace shakedown
