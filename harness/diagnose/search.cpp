// SPDX-License-Identifier: MIT
// One round of the search: which effect, beside what the model has, would explain what is left?
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "errors.hpp"
#include "expect.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "nuisance.hpp"
#include "pair_rivals.hpp"
#include "rival.hpp"
#include "rules.hpp"
#include "setup_keys.hpp"
#include "state.hpp"

namespace shakedown {

namespace {

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

/// The data reject the model, and what imitates an effect has led its restitutions to where hardly anything
/// tells of effects: of restitutions of .345 and .999 neither friction nor attraction sees anything.
bool is_led_astray(const DiagnosisState& state) {
  return is_rejected(state.fit) && std::any_of(state.theta.begin(), state.theta.end(), [](const Knob& knob) {
           return is_believed(knob) &&
                  std::abs(knob.centre - knob.believed) > effort::astray * knob.believed_error;
         });
}

/// Its parameters back at what was believed of them before a fit led them astray, each as wide as a line
/// reaches there: a frequency that is 0.06 % off turns the phase by a hundredth after fifteen swings.
DiagnosisState as_believed(DiagnosisState state) {
  constexpr double of_a_restitution = 0.5, of_the_frequency = 0.15;  // of the first fit's box
  for (const Knob& before : state.before_fits)
    for (Knob& knob : state.theta) {
      if (knob.key != before.key) continue;
      knob = before;
      knob.width *= knob.key == "spring.frequency" ? of_the_frequency : of_a_restitution;
    }
  return state;
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
  // A component test told it: a parameter of the fit, or fixed.
  std::erase_if(candidates, [&](const Candidate& candidate) {
    const std::vector<std::string> keys = joined_keys(candidate.fitted_knobs().front().key);
    return std::any_of(keys.begin(), keys.end(), [&](const std::string& key) {
      return find_known(tools.measurement().known, key) != nullptr && find_setup_key(key) == nullptr;
    });
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

/// The data accept it as fitted.
bool holds(const Rival& rival) { return rival.fitted && rival.state.fit.p_value > rules::holds; }

/// Until one holds.
void fit_pairs(const DiagnosisState& from, DiagnosisTools& tools, EffectScreen& screen, double& lowest,
               std::vector<PairRival>& pairs, SearchRound& round) {
  const double known = static_cast<double>(tools.known().size());
  for (PairRival& pair : pairs) try {
      const bool dear = pair.first.candidate->dear || pair.second.candidate->dear;
      fit_pair(pair, from, tools, screen, lowest, dear ? effort::attempt_when_dear : effort::attempt, known);
      lowest = std::min(lowest, pair.second.state.fit.judged_chi2);
      if (holds(pair.second)) break;
    } catch (const BudgetSpent&) {
      break;
    } catch (const PhysicsError& error) {
      round.notes.push_back(pair.second.candidate->effect + " and " + pair.first.candidate->effect +
                            " could not be tried: " + error.what());
    } catch (const InputError& error) {
      round.notes.push_back(pair.second.candidate->effect + " and " + pair.first.candidate->effect +
                            " could not be tried: " + error.what());
    }
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
  const bool astray = is_led_astray(state);
  const DiagnosisState from = astray ? as_believed(state) : state;
  const std::vector<Candidate> candidates = open_candidates(from, tools, seen_by_balance);
  if (candidates.empty()) {
    weigh(round.table);
    return round;
  }
  tools.begin("ranking the effects");
  const double all = static_cast<double>(tools.known().size());
  const ScreenEffort& ranking = state.dear ? effort::rank_when_dear : effort::rank;
  EffectScreen screen(tools.features(from.setup), from.knobs(), tools.workshop(), ranking, tools.next_batch(),
                      astray ? ScreenStart{} : start_from(state.fit, state.knobs()));
  const double nothing_gained =
      astray ? std::max(0.0, screen.log_likelihood_ratio(tools.features(state.setup), state.knobs(),
                                                         ranking.nothing))
             : 0;
  const Screening screening = screen.weigh(candidates);
  std::vector<Rival> rivals;
  for (const ScreenedEffect& screened : screening.list)
    rivals.push_back({.candidate = &candidates[screened.candidate],
                      .screened = screened,
                      .nothing_gained = nothing_gained});
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
      fit_rival(rival, from, tools, screen, lowest, effort);
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
  // A fit may find more than any signature promised: it is to be weighed beside fits of those that promised
  // as much, not beside their signatures.
  double promised = -std::numeric_limits<double>::infinity();
  for (const Rival& rival : rivals)
    if (rival.weighed) promised = std::max(promised, rival.log_odds);
  std::vector<PairRival> pairs;
  if (rejected && static_cast<double>(state.missing.size()) + 2 <= rules::most_effects)
    pairs = pairs_beyond(rivals, screen.pairs(candidates), candidates, all);
  if (pairs.size() > effort::most_pairs) pairs.resize(effort::most_pairs);
  const bool pairs_first = !pairs.empty() && is_far_beyond(pairs.front(), rivals);
  bool pairs_tried = false;
  for (bool more = true; more && tried < static_cast<int>(rules::most_tried);) {
    more = false;
    // Two that the data reject each alone may hold together.
    if (rejected && !pairs_tried && (tried > 0 || pairs_first) &&
        std::none_of(rivals.begin(), rivals.end(), holds)) {
      pairs_tried = true;
      fit_pairs(from, tools, screen, lowest, pairs, round);
      if (std::any_of(pairs.begin(), pairs.end(), [](const PairRival& pair) { return holds(pair.second); }))
        break;
    }
    std::stable_sort(order.begin(), order.end(), by_odds);
    // A model that the data reject is not what is there: while nothing was found, the best of a bad lot are
    // fitted whatever their odds.
    const bool all_bad = rejected && std::none_of(rivals.begin(), rivals.end(), is_found);
    const double best = std::min(promised, order.front()->log_odds);
    const double worth_a_fit =
        all_bad ? -std::numeric_limits<double>::infinity()
                : std::max(worth_asking, best - std::max(std::log(10), effort::signature_errs * best));
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
  if (rejected) weigh_beside_the_best(rivals, all);
  std::stable_sort(order.begin(), order.end(), by_odds);
  for (Rival* rival : order) {
    if (rival->weighed) round.ranking.push_back(ranked_as(*rival));
    if (std::isfinite(rival->log_odds))
      round.table.push_back({{rival->candidate->effect}, rival->log_odds, 0});
  }
  const PairRival* best_pair = nullptr;
  for (const PairRival& pair : pairs) {
    round.table.push_back({pair.effects(), pair.log_odds, 0});
    if (pair.fitted && pair.log_odds > (best_pair == nullptr ? 0 : best_pair->log_odds)) best_pair = &pair;
  }
  weigh(round.table);
  if (probability_of_something(round.table) <= rules::adds_effect) return round;
  std::vector<Rival*> fitted;
  for (Rival* rival : order)
    if (is_found(*rival)) fitted.push_back(rival);
  std::stable_sort(fitted.begin(), fitted.end(), by_odds);
  if (best_pair != nullptr && (fitted.empty() || best_pair->log_odds > fitted[0]->log_odds)) {
    round.added = true;
    round.next = best_pair->second.state.settled(tools.known());
    return round;
  }
  if (fitted.empty()) return round;
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

namespace {

/// Two strengths that do much the same have two valleys: most of the one, or most of the other. The better of
/// both fits; where the data do not tell which, its intervals reach over both.
Refit with_other_valley(const DiagnosisState& apart, const std::vector<std::string>& parts,
                        DiagnosisTools& tools, const std::string& stage) {
  DiagnosisState other = apart;
  const auto value_of = [&](const Refit& fit, const std::string& key) {
    return std::find_if(fit.values.begin(), fit.values.end(),
                        [&](const FittedValue& value) { return value.key == key; });
  };
  double sum = 0;
  for (const std::string& key : parts) sum += value_of(apart.fit, key)->value;
  const double mean = sum / static_cast<double>(parts.size());
  for (Knob& part : other.found) {
    if (std::find(parts.begin(), parts.end(), part.key) == parts.end()) continue;
    // What was below the mean begins where the range of such strengths ends (three times what both are
    // together, as in `concluded`), what was above it at half the mean.
    const bool was_below = value_of(apart.fit, part.key)->value < mean;
    part.centre = std::clamp(was_below ? 3 * mean : mean / 2, part.low, part.high);
    part.width = std::min(part.width, std::max(part.centre / 2, part.width / 10));
  }
  other.fit = tools.fit(other, stage, other.knobs(), effort::attempt);
  const double better = (apart.fit.scatter - other.fit.scatter) * apart.fit.degrees;
  if (std::abs(better) > rules::emulator_noise) return better > 0 ? other.fit : apart.fit;
  Refit both = better > 0 ? other.fit : apart.fit;
  for (FittedValue& value : both.values)
    for (const Refit* fit : {&std::as_const(apart).fit, &std::as_const(other).fit}) {
      const auto there = value_of(*fit, value.key);
      value.low = std::min(value.low, there->low), value.high = std::max(value.high, there->high);
    }
  return both;
}

}  // namespace

DiagnosisState concluded(const DiagnosisState& state, DiagnosisTools& tools, const std::string& stage) {
  DiagnosisState whole = state;
  if (std::none_of(state.found.begin(), state.found.end(), is_joint)) {
    whole.fit = tools.fit(state, stage, state.knobs(), effort::conclude);
    return whole;
  }
  DiagnosisState apart = state;
  apart.found = taken_apart(state.found);
  std::vector<std::string> parts;
  for (Knob& part : apart.found) {
    // One may be far from what both were together: from nothing to three times that.
    const bool was_joint = std::none_of(state.found.begin(), state.found.end(),
                                        [&](const Knob& knob) { return knob.key == part.key; });
    if (!was_joint) continue;
    parts.push_back(part.key);
    part.width = std::max(part.width, 1.5 * (part.centre - part.low));
    part.centre = std::max(part.centre, part.low + part.width);
  }
  apart.fit = tools.fit(apart, stage, apart.knobs(), effort::apart);
  try {
    apart.fit = with_other_valley(apart, parts, tools, stage);
  } catch (const BudgetSpent&) {  // the one that was found has to do
  }
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
