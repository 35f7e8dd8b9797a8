// SPDX-License-Identifier: MIT
// One round of the search: which effect, beside what the model has, would explain what is left?
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "errors.hpp"
#include "expect.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "nuisance.hpp"
#include "rules.hpp"
#include "setup_keys.hpp"
#include "state.hpp"

namespace shakedown {

namespace {

/// A candidate on its way through a round.
struct Rival {
  const Candidate* candidate;
  ScreenedEffect screened;
  double log_odds = 0;
  double held_out_gain = 0;         ///< of chi2, fitted
  double log_ratio = std::nan("");  ///< ln likelihood of the fitted model over that before, means and spreads
  bool fitted = false;
  DiagnosisState state{};  ///< where it was fitted
  bool weighed = false;    ///< log_odds is more than its prior
  bool attempted = false;  ///< its fit had its turn
};

/// What it does to the features is arithmetic on the recording: its signature is exact, and the gain of a
/// fit, which chaos makes, would tell less.
bool is_arithmetic(const Rival& rival) { return rival.candidate->fitted_knobs().front().exact; }

bool is_joint(const Knob& knob) { return joined_keys(knob.key).size() > 1; }

/// What moves together, each by itself.
std::vector<Knob> taken_apart(const std::vector<Knob>& knobs) {
  std::vector<Knob> parts;
  for (const Knob& knob : knobs)
    for (const std::string& key : joined_keys(knob.key)) {
      parts.push_back(knob);
      parts.back().key = key;
    }
  return parts;
}

/// Without the effect the restitutions were led astray: the box reaches from there to what the user gave.
std::vector<Knob> covering_the_users_values(std::vector<Knob> knobs) {
  for (Knob& knob : knobs) {
    if (!is_believed(knob)) continue;
    const double apart = std::abs(knob.centre - knob.believed);
    knob.centre = (knob.centre + knob.believed) / 2;
    knob.width = apart / 2 + 0.8 * knob.believed_error;
  }
  return knobs;
}

/// The fit of a candidate begins at the strength that its signature asks for.
std::vector<Knob> knobs_of(const Candidate& candidate, const ScreenedEffect& screened) {
  std::vector<Knob> added = candidate.fitted_knobs();
  for (Knob& knob : added) {
    if (std::isinf(knob.absent))  // a length, known by what it does
      knob.width *= screened.value / knob.centre;
    else
      knob.width = std::max(knob.width, 0.5 * std::abs(screened.value - knob.absent));
    knob.centre = std::clamp(screened.value, knob.low, knob.high);
  }
  return added;
}

/// An exact knob of the camera that the candidate itself moves is no nuisance beside it.
std::vector<Knob> without(std::vector<Knob> knobs, const std::vector<Knob>& these) {
  std::erase_if(knobs, [&](const Knob& knob) {
    return std::any_of(these.begin(), these.end(), [&](const Knob& other) { return other.key == knob.key; });
  });
  return knobs;
}

/// Knobs at the values of a fit.
std::vector<Knob> at_values(const Refit& fit) {
  std::vector<Knob> knobs = fit.knobs;
  for (std::size_t k = 0; k < knobs.size(); ++k)
    if (!knobs[k].exact) knobs[k].centre = fit.values[k].value;
  return knobs;
}

/// What the screen of the model at `knobs`, where this fit has put it, need not simulate again.
ScreenStart start_from(const Refit& fit, const std::vector<Knob>& knobs) {
  ScreenStart start{fit.for_means, fit.covariances};
  const auto cut_off = [](const FittedValue& value) { return value.at_bound; };
  if (fit.at_solution.empty() || knobs.size() != fit.knobs.size() ||
      std::any_of(fit.values.begin(), fit.values.end(), cut_off))
    return start;
  start.knobs = at_values(fit);
  start.emulators = fit.at_solution;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    EXPECT(knobs[k].key == fit.knobs[k].key);
    // What is arithmetic on the recording stays where the recording was read.
    if (!knobs[k].exact) continue;
    const double moved = fit.knobs[k].z_of(fit.values[k].value);
    for (Emulator& e : start.emulators)
      e.coefficients.row(0) -= moved * e.coefficients.row(1 + static_cast<Eigen::Index>(k));
  }
  return start;
}

void fit_rival(Rival& rival, const DiagnosisState& before, DiagnosisTools& tools, EffectScreen& screen,
               double lowest, Effort effort) {
  const Candidate& candidate = *rival.candidate;
  DiagnosisState& state = rival.state = before;
  state.setup = prepared(before.setup, candidate, tools.known());
  const std::vector<Knob> added = knobs_of(candidate, rival.screened);
  state.found = together(before.found, added);
  state.camera = without(before.camera, added);
  if (std::find(state.missing.begin(), state.missing.end(), candidate.effect) == state.missing.end())
    state.missing.push_back(candidate.effect);  // else of another component
  const std::vector<Knob> knobs =
      together(together(covering_the_users_values(before.theta), state.found), state.camera);
  const std::string stage = "trying " + candidate.effect;
  state.fit = tools.fit(state, stage, knobs, effort, &before.fit, lowest);
  state.dear = before.dear || candidate.dear;
  rival.fitted = true;
  rival.held_out_gain = before.fit.judged_held_out_chi2 - state.fit.judged_held_out_chi2;
  if (is_arithmetic(rival)) return;
  const ScreenEffort& weighing = state.dear ? effort::rank_when_dear : effort::rank;
  try {
    rival.log_ratio =
        screen.log_likelihood_ratio(tools.features(state.setup), at_values(state.fit), weighing.nothing);
  } catch (const BudgetSpent&) {  // the signature's evidence stands
  }
}

/// Of this effect in any of its forms, among these, each alone, and nothing.
double probability_among(const std::vector<Rival>& rivals, const Rival& one) {
  std::vector<Hypothesis> table{{{}, 0, 0}};
  for (const Rival& rival : rivals)
    if (std::isfinite(rival.log_odds)) table.push_back({{rival.candidate->effect}, rival.log_odds, 0});
  weigh(table);
  double sum = 0;
  for (const Hypothesis& h : table)
    if (h.effects == std::vector<std::string>{one.candidate->effect}) sum += h.probability;
  return sum;
}

/// The fitted strength of a rival, as the prior counts it.
StrengthSeen strength_fitted(const Rival& rival) {
  StrengthSeen seen = rival.screened.seen;
  const std::vector<Knob> added = rival.candidate->fitted_knobs();
  const Refit& fit = rival.state.fit;
  for (std::size_t k = 0; k < fit.values.size(); ++k)
    for (const Knob& knob : added)
      if (fit.values[k].key == knob.key && rival.candidate->knobs.size() > 0) {
        std::tie(seen.value, seen.error) = strength_of(fit, k);
        if (seen.one_sided) seen.value = std::abs(seen.value);
      }
  return seen;
}

/// The table is of what the signatures say, and of fitted models where they were weighed. The chi2 of two
/// fits differ by chaos alone as much as effects that matter do.
void weigh_rival(Rival& rival, double candidates) {
  rival.weighed = rival.fitted || rival.screened.weighed;
  const StrengthSeen& seen = rival.screened.seen;
  rival.log_odds = prior_log_odds(seen.odds, candidates);
  if (rival.screened.weighed) rival.log_odds += rival.screened.log_evidence;
  if (!std::isfinite(rival.log_ratio)) return;
  StrengthSeen fitted = strength_fitted(rival);
  fitted.gain = 2 * rival.log_ratio;
  rival.log_odds = log_odds_of(fitted, candidates);
}

RankedEffect ranked_as(const Rival& rival) {
  RankedEffect ranked{rival.candidate->effect, rival.screened.gain,       std::nan(""), std::nan(""),
                      rival.screened.value,    rival.screened.look_alikes};
  if (!rival.fitted) return ranked;
  ranked.fitted = true;
  if (std::isfinite(rival.log_ratio)) ranked.gain = 2 * rival.log_ratio;
  ranked.held_out_gain = rival.held_out_gain;
  // of a difference of two chi2 of nested models
  ranked.standard_error = 2 * std::sqrt(std::abs(rival.held_out_gain));
  for (const FittedValue& value : rival.state.fit.values)
    for (const Knob& knob : rival.candidate->fitted_knobs())
      if (value.key == knob.key) ranked.value = value.value;
  return ranked;
}

std::vector<Candidate> open_candidates(const DiagnosisState& state, DiagnosisTools& tools,
                                       const std::vector<std::string>& seen_by_balance) {
  // What replaces a parameter is absent at the value that the fit has found of it.
  Setup at_fit = state.setup;
  for (const Knob& knob : state.theta) set_knob(at_fit, knob, tools.known());
  std::vector<Candidate> candidates =
      candidates_for(at_fit, tools.options().effects, tools.known(), *tools.workshop().engine);
  const std::vector<std::string> exact = exactly_known(tools.measurement(), tools.known());
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return std::find(exact.begin(), exact.end(), candidate.effect) != exact.end();
  });
  std::erase_if(candidates, [&](const Candidate& candidate) {
    const auto judged = [&](const std::string& key) {
      return std::find(seen_by_balance.begin(), seen_by_balance.end(), key) != seen_by_balance.end();
    };
    if (!candidate.knobs.empty()) return judged(candidate.knobs.front().key);
    return !candidate.fixed.empty() && judged(candidate.fixed.front().first);
  });
  return candidates;
}

/// ln of the odds within which physics is not named where the camera explains as much: an assumption, a
/// factor of e.
constexpr double as_much = 1;

void camera_first(std::vector<Rival*>& order, DiagnosisTools& tools) {
  const auto of_camera = [&](const Rival* rival) {
    const EffectRecord* record = find_record(tools.known(), rival->candidate->effect);
    return record != nullptr && record->acts_on == ActsOn::camera;
  };
  if (order.size() > 1 && order[1]->log_odds > order[0]->log_odds - as_much && of_camera(order[1]) &&
      !of_camera(order[0]))
    std::swap(order[0], order[1]);
}

}  // namespace

std::vector<Hypothesis> not_looked_at(const DiagnosisState& state, DiagnosisTools& tools,
                                      const std::vector<std::string>& seen_by_balance) {
  std::vector<Hypothesis> table{{{}, 0, 0}};
  const double all = static_cast<double>(tools.known().size());
  for (const Candidate& candidate : open_candidates(state, tools, seen_by_balance))
    table.push_back({{candidate.effect}, prior_log_odds(candidate.prior.odds, all), 0});
  weigh(table);
  return table;
}

SearchRound search_round(const DiagnosisState& state, DiagnosisTools& tools,
                         const std::vector<std::string>& seen_by_balance) {
  SearchRound round{{{{}, 0, 0}}, {}, {}, {}, false, state, "", {}};
  const std::vector<Candidate> candidates = open_candidates(state, tools, seen_by_balance);
  if (candidates.empty()) {
    weigh(round.table);
    return round;
  }
  tools.begin("ranking the effects");
  const double all = static_cast<double>(tools.known().size());
  EffectScreen screen(tools.features(state.setup), state.knobs(), tools.workshop(),
                      state.dear ? effort::rank_when_dear : effort::rank, tools.next_batch(),
                      start_from(state.fit, state.knobs()));
  const Screening screening = screen.weigh(candidates);
  std::vector<Rival> rivals;
  for (const ScreenedEffect& screened : screening.list)
    rivals.push_back({&candidates[screened.candidate], screened});
  for (const Screening::LeftOut& left_out : screening.left_out) {
    round.notes.push_back(left_out.effect + " was not looked for: it cannot be simulated here (" +
                          left_out.reason + ")");
    round.table.push_back({{left_out.effect}, prior_log_odds(1, all), 0});
  }
  for (Rival& rival : rivals) weigh_rival(rival, all);
  std::vector<Rival*> order;
  for (Rival& rival : rivals) order.push_back(&rival);
  const double worth_asking = std::log(rules::doubtful);  // less than the odds at which a model is doubted
  const auto by_odds = [](const Rival* a, const Rival* b) { return a->log_odds > b->log_odds; };
  std::stable_sort(order.begin(), order.end(), by_odds);
  for (const Rival& rival : rivals)
    if (!rival.weighed) round.not_tried.push_back(rival.candidate->effect);
  double lowest = state.fit.judged_chi2;
  int tried = 0;
  const auto attempt = [&](Rival& rival) {
    rival.attempted = true;
    if (tried >= static_cast<int>(rules::most_tried)) return;
    ++tried;
    const auto could_not = [&](const std::exception& error) {
      round.notes.push_back(rival.candidate->effect + " could not be tried: " + error.what());
    };
    const auto fit = [&](Effort effort) {
      fit_rival(rival, state, tools, screen, lowest, effort);
      lowest = std::min(lowest, rival.state.fit.judged_chi2);
      weigh_rival(rival, all);
    };
    try {
      try {
        fit(rival.candidate->dear ? effort::attempt_when_dear : effort::attempt);
      } catch (const BudgetSpent&) {
        // What is sure is fitted with what was kept for the last fit.
        if (probability_among(rivals, rival) <= rules::adds_effect) throw;
        tools.limit_to(1);
        fit(effort::least);
      }
    } catch (const BudgetSpent&) {
      round.not_tried.push_back(rival.candidate->effect);
    } catch (const PhysicsError& error) {
      could_not(error);
    } catch (const InputError& error) {
      could_not(error);
    }
  };
  // Fits confirm the most probable, and what has more than a tenth of its probability; where a fit takes back
  // what a signature promised, the next has its turn.
  const bool rejected = is_rejected(state.fit);
  const auto is_found = [](const Rival& rival) { return rival.fitted && rival.log_odds > 0; };
  for (bool more = true; more && tried < static_cast<int>(rules::most_tried);) {
    more = false;
    std::stable_sort(order.begin(), order.end(), by_odds);
    // A model that the data reject is not what is there: while nothing was found, the best of a bad lot are
    // fitted whatever their odds.
    const bool all_bad = rejected && std::none_of(rivals.begin(), rivals.end(), is_found);
    const double worth_a_fit = all_bad ? -std::numeric_limits<double>::infinity()
                                       : std::max(worth_asking, order.front()->log_odds - std::log(10));
    for (Rival* rival : order) {
      // Of what is arithmetic only the fit that is to be added is needed.
      const double least =
          is_arithmetic(*rival) ? std::max(0.0, order.front()->log_odds - as_much) : worth_a_fit;
      if (rival->attempted || !rival->weighed || !(rival->log_odds > least)) continue;
      attempt(*rival);
      more = true;
      break;
    }
  }
  for (Rival* rival : order) {
    if (rival->weighed) round.ranking.push_back(ranked_as(*rival));
    if (std::isfinite(rival->log_odds))
      round.table.push_back({{rival->candidate->effect}, rival->log_odds, 0});
  }
  weigh(round.table);
  if (probability_of_something(round.table) <= rules::adds_effect) return round;
  std::vector<Rival*> fitted;
  for (Rival* rival : order)
    if (is_found(*rival)) fitted.push_back(rival);
  if (fitted.empty()) return round;
  std::stable_sort(fitted.begin(), fitted.end(), by_odds);
  camera_first(fitted, tools);
  round.added = true;
  round.next = fitted[0]->state.settled(tools.known());
  const auto second = std::find_if(fitted.begin(), fitted.end(), [&](const Rival* rival) {
    return rival->candidate->effect != fitted[0]->candidate->effect;
  });
  if (second != fitted.end()) {
    round.runner_up = (*second)->candidate->effect;
    round.runner_up_setup = (*second)->state.settled(tools.known()).setup;
  }
  return round;
}

DiagnosisState concluded(const DiagnosisState& state, DiagnosisTools& tools, const std::string& stage) {
  DiagnosisState whole = state;
  if (std::none_of(state.found.begin(), state.found.end(), is_joint)) {
    whole.fit = tools.fit(state, stage, state.knobs(), effort::conclude);
    return whole;
  }
  DiagnosisState apart = state;
  apart.found = taken_apart(state.found);
  for (Knob& part : apart.found) {
    // One may be far from what both were together: from nothing to three times that.
    const bool was_joint = std::none_of(state.found.begin(), state.found.end(),
                                        [&](const Knob& knob) { return knob.key == part.key; });
    if (was_joint)
      part.width = std::max(part.width, 1.5 * (part.centre - part.low)),
      part.centre = std::max(part.centre, part.low + part.width);
  }
  apart.fit = tools.fit(apart, stage, apart.knobs(), effort::apart);
  // too many to follow
  if ((apart.fit.scatter - state.fit.scatter) * apart.fit.degrees > rules::emulator_noise) {
    whole.fit = tools.fit(state, stage, state.knobs(), effort::conclude);
    return whole;
  }
  return apart;
}

DiagnosisState pruned(const DiagnosisState& state, DiagnosisTools& tools,
                      const std::vector<std::string>& from_balance) {
  if (state.missing.size() < 2) return state;
  for (std::size_t i = 0; i + 1 < state.missing.size(); ++i) {
    const std::string effect = state.missing[i];
    if (std::find(from_balance.begin(), from_balance.end(), effect) != from_balance.end()) continue;
    constexpr double beyond_doubt = 2;  // standard errors: what a 95 % interval leaves out
    if (is_told(state.fit, effect, beyond_doubt)) continue;
    DiagnosisState less = state;
    std::erase_if(less.setup.effects,
                  [&](const EffectChoice& choice) { return choice.record->name == effect; });
    std::erase_if(less.found, [&](const Knob& knob) { return effect_of(knob.key) == effect; });
    less.missing.erase(less.missing.begin() + static_cast<std::ptrdiff_t>(i));
    less.fit = tools.fit(less, "is " + effect + " still needed?", less.knobs(), effort::beside);
    if (less.fit.p_value <= rules::holds &&
        (less.fit.scatter - state.fit.scatter) * state.fit.degrees > rules::emulator_noise)
      continue;
    return pruned(less, tools, from_balance);
  }
  return state;
}

}  // namespace shakedown
