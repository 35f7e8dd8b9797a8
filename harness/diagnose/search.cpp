// SPDX-License-Identifier: MIT
// Makes one round of the search: which effect, beside what the model has, would explain what is left?
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
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

std::vector<Candidate> open_candidates(const DiagnosisState& state, DiagnosisTools& tools,
                                       const std::vector<std::string>& seen_by_balance) {
  // What replaces a parameter is absent at the value that the fit has found of it.
  Setup at_fit = state.setup;
  for (const Knob& knob : state.theta) set_knob(at_fit, knob, tools.known());
  std::vector<Candidate> candidates =
      candidates_for(at_fit, tools.options().effects, tools.known(), *tools.workshop().engine, state.theta);
  const std::vector<std::string> exact = exactly_known(tools.measurement(), tools.known());
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return std::find(exact.begin(), exact.end(), candidate.effect) != exact.end();
  });
  // Leave out what a component test told: it is a parameter of the fit, or fixed.
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
    const EffectRecord* record = tools.known().find(rival->candidate->effect);
    return record != nullptr && record->acts_on == ActsOn::camera;
  };
  if (order.size() > 1 && order[1]->log_odds > order[0]->log_odds - as_much && of_camera(order[1]) &&
      !of_camera(order[0]))
    std::swap(order[0], order[1]);
}

/// Makes the steps of one round, and holds what they share.
class Round {
 public:
  Round(const DiagnosisState& state, DiagnosisTools& tools, const std::vector<std::string>& seen_by_balance)
      : state_(state),
        tools_(tools),
        astray_(is_led_astray(state)),
        from_(astray_ ? as_believed(state) : state),
        candidates_(open_candidates(from_, tools, seen_by_balance)),
        searched_(static_cast<double>(tools.known().searched())),
        rejected_(is_rejected(state.fit)),
        far_off_(is_far_off(state.fit)),
        lowest_(state.fit.own_chi2) {
    round_.next = state;
  }

  SearchRound run() {
    if (!candidates_.empty()) {
      tools_.begin("ranking the effects");
      rank();
      if (far_off_) fit_each_shortly();
      for (Rival& rival : rivals_)
        if (!rival.weighed && std::isnan(rival.short_chi2)) leave_out(rival);
      fit_the_most_probable();
      if (rejected_) weigh_beside_the_best(rivals_, searched_);
    }
    tell();
    if (probability_of_something(round_.table) > rules::adds_effect) add_the_best();
    if (!round_.added) promise_the_most_probable();
    return std::move(round_);
  }

 private:
  /// Ranks every effect by its signature, and pairs of them.
  void rank() {
    const ScreenEffort& closely = state_.dear ? effort::rank_when_dear : effort::rank;
    const ScreenEffort ranking = far_off_ ? effort::at_the_middle(closely) : closely;
    screen_ = std::make_unique<EffectScreen>(
        tools_.features(from_.setup), from_.knobs(), tools_.workshop(), ranking, tools_.next_batch(),
        astray_ ? ScreenStart{} : start_from(state_.fit, state_.knobs()));
    if (astray_)
      nothing_gained_ = std::max(
          0.0, screen_->log_likelihood_ratio(tools_.features(state_.setup), state_.knobs(), ranking.nothing));
    const Screening screening = screened();
    for (const ScreenedEffect& screened : screening.list)
      rivals_.push_back({.candidate = &candidates_[screened.candidate],
                         .screened = screened,
                         .nothing_gained = nothing_gained_});
    for (const Screening::LeftOut& left_out : screening.left_out) {
      round_.notes.push_back(left_out.effect + " was not looked for: it cannot be simulated here (" +
                             left_out.reason + ")");
      round_.table.push_back({{left_out.effect}, prior_log_odds(1, searched_), 0});
    }
    for (Rival& rival : rivals_) {
      weigh_rival(rival, searched_);
      order_.push_back(&rival);
    }
    if (rejected_ && static_cast<double>(state_.missing.size()) + 2 <= rules::most_effects)
      pairs_ = pairs_beyond(rivals_, screen_->pairs(candidates_), candidates_, searched_);
    if (pairs_.size() > effort::most_pairs) pairs_.resize(effort::most_pairs);
  }

  /// Simulates signatures, in the part of the round that they may take.
  Screening screened() {
    const KeptLimit whole(tools_);
    const double spent = std::min(whole.share(), tools_.share_spent());
    tools_.limit_to(spent + (far_off_ ? share::ranking_when_far_off : share::ranking_of_a_round) *
                                (whole.share() - spent));
    return screen_->weigh(candidates_);
  }

  /// Fits every effect shortly, the cheap ones first, to see which are worth a fit that weighs them: about
  /// parameters that are far off no line reaches what is missing, and what a signature promises says little.
  /// While the data accept none of them the next one is worth more than a longer fit of one that they reject.
  void fit_each_shortly() {
    sort_by_odds();
    std::vector<Rival*> open;
    for (Rival* rival : order_)
      // A length has no strength to begin with but that of its signature.
      if (!is_arithmetic(*rival) && (rival->weighed || !rival->candidate->knobs.empty()))
        open.push_back(rival);
    std::stable_sort(open.begin(), open.end(), [](const Rival* a, const Rival* b) {
      return a->candidate->plain_runs() < b->candidate->plain_runs();
    });
    const KeptLimit whole(tools_);
    const double spent = std::min(whole.share(), tools_.share_spent());
    const auto limit_to = [&](double share) { tools_.limit_to(spent + share * (whole.share() - spent)); };
    limit_to(share::short_fits_while_none_holds);
    for (Rival* rival : open) try {
        fit_shortly(*rival, from_, tools_);
        if (rival->short_holds) limit_to(share::short_fits_of_the_rest);
      } catch (const BudgetSpent&) {
        break;
      } catch (const PhysicsError&) {  // the fit that weighs it will say so
      } catch (const InputError&) {
      }
    // Drop the short fits of the others: they are no answer, and a fit's state is large.
    const std::vector<Rival*> kept = in_question(rivals_);
    for (Rival& rival : rivals_)
      if (std::find(kept.begin(), kept.end(), &rival) == kept.end()) rival.shortly.reset();
  }

  /// Fits the most probable, and what has more than a tenth of its probability; where a fit takes back what a
  /// signature promised, the next has its turn.
  void fit_the_most_probable() {
    // A fit may find more than any signature promised: it is to be weighed beside fits of those that promised
    // as much, not beside their signatures.
    double promised = -std::numeric_limits<double>::infinity();
    for (const Rival& rival : rivals_)
      if (rival.weighed) promised = std::max(promised, rival.log_odds);
    bool pairs_due = !pairs_.empty();
    const bool pairs_first = pairs_due && !far_off_ && is_far_beyond(pairs_.front(), rivals_);
    while (tried_ < static_cast<int>(rules::most_tried)) {
      // Two that the data reject each alone may hold together.
      if (pairs_due && (tried_ > 0 || pairs_first) && none_holds() && in_question(rivals_).empty()) {
        pairs_due = false;
        fit_pairs();
        if (std::any_of(pairs_.begin(), pairs_.end(),
                        [](const PairRival& p) { return p.fitted && holds(p.second); }))
          return;
      }
      Rival* next = next_to_fit(promised);
      if (next == nullptr) return;
      attempt(*next);
    }
  }

  bool none_holds() const { return std::none_of(rivals_.begin(), rivals_.end(), holds); }

  void sort_by_odds() {
    std::stable_sort(order_.begin(), order_.end(),
                     [](const Rival* a, const Rival* b) { return a->log_odds > b->log_odds; });
  }

  /// Returns the rival to fit next; null where none is worth a fit.
  Rival* next_to_fit(double promised) {
    if (order_.empty()) return nullptr;
    sort_by_odds();
    // A model that the data reject is not what is there: while nothing was found, the most probable are
    // fitted whatever their odds; two of them where it may be two codes that differ.
    const bool poor = state_.fit.p_value <= rules::holds && tried_ < effort::fitted_where_poor;
    const bool all_bad = (rejected_ || poor) && std::none_of(rivals_.begin(), rivals_.end(), is_found);
    const double worth_asking = std::log(rules::doubtful);  // less than the odds at which a model is doubted
    const double best = std::min(promised, order_.front()->log_odds);
    const double worth_a_fit = all_bad ? -std::numeric_limits<double>::infinity()
                                       : std::max(worth_asking, best - signatures_err_by(best));
    if (const std::vector<Rival*> shortly = in_question(rivals_);
        !shortly.empty() && (none_holds() || shortly.front()->short_holds))
      return shortly.front();
    std::vector<Rival*> open;
    for (Rival* rival : order_) {
      // An arithmetic effect is fitted only if it will be added.
      const double least =
          is_arithmetic(*rival) ? std::max(0.0, order_.front()->log_odds - as_much) : worth_a_fit;
      if (!rival->attempted && rival->weighed && rival->log_odds > least) open.push_back(rival);
    }
    return first_to_fit(open);
  }

  void attempt(Rival& rival) {
    rival.attempted = true;
    ++tried_;
    const auto fit = [&](Effort effort) {
      fit_rival(rival, from_, tools_, *screen_, lowest_, effort);
      lowest_ = std::min(lowest_, rival.state.fit.judged_chi2);
      weigh_rival(rival, searched_);
    };
    try {
      try {
        fit(affordable(rival, rival.candidate->dear ? effort::attempt_when_dear : effort::attempt,
                       tools_.limit() - tools_.share_spent()));
      } catch (const BudgetSpent&) {
        if (rival.shortly && is_alone_in_question(rivals_, rival)) throw;  // its short fit stands
        // A nearly certain effect may use what is kept for the last fit.
        if (probability_among(rivals_, rival) <= rules::adds_effect && !is_alone_in_question(rivals_, rival))
          throw;
        const KeptLimit limit(tools_);
        tools_.limit_to(1);
        fit(effort::least);
      }
    } catch (const BudgetSpent&) {
      if (!take_short_fit(rivals_, rival)) return leave_out(rival);
      round_.notes.push_back("there was no time for more than a short fit of " + rival.candidate->effect +
                             ": its intervals are wide (--seconds, --budget)");
      weigh_rival(rival, searched_);
    } catch (const PhysicsError& error) {
      note_failure(rival.candidate->effect, error);
    } catch (const InputError& error) {
      note_failure(rival.candidate->effect, error);
    }
  }

  /// Fits pairs until the data accept one.
  void fit_pairs() {
    for (PairRival& pair : pairs_) try {
        const bool dear = pair.first.candidate->dear || pair.second.candidate->dear;
        fit_pair(pair, from_, tools_, *screen_, lowest_, dear ? effort::attempt_when_dear : effort::attempt);
        weigh_pair(pair, searched_);
        lowest_ = std::min(lowest_, pair.second.state.fit.judged_chi2);
        if (holds(pair.second)) return;
      } catch (const BudgetSpent&) {
        round_.not_tried.push_back(pair.words());
        return;
      } catch (const PhysicsError& error) {
        note_failure(pair.words(), error);
      } catch (const InputError& error) {
        note_failure(pair.words(), error);
      }
  }

  void note_failure(const std::string& what, const std::exception& error) {
    round_.notes.push_back(what + " could not be tried: " + error.what());
  }

  /// Fills in ranking and table. A pair stands in the table where it was fitted: beside one of its effects
  /// alone the next round asks for the other.
  void tell() {
    sort_by_odds();
    for (Rival* rival : order_) {
      if (rival->weighed) round_.ranking.push_back(ranked_as(*rival));
      if (std::isfinite(rival->log_odds))
        round_.table.push_back({{rival->candidate->effect}, rival->log_odds, 0});
    }
    if (const PairRival* pair = best_pair()) round_.table.push_back({pair->effects(), pair->log_odds, 0});
    weigh(round_.table);
  }

  /// Returns the best pair; null where none was fitted and weighed, or where the data accept a single effect
  /// and no pair: odds told in the metric of a model that is wrong say nothing against that effect.
  const PairRival* best_pair() const {
    const PairRival* best = nullptr;
    for (const PairRival& pair : pairs_)
      if (pair.fitted && std::isfinite(pair.log_odds) && (none_holds() || holds(pair.second)) &&
          (best == nullptr || pair.log_odds > best->log_odds))
        best = &pair;
    return best;
  }

  void add_the_best() {
    std::vector<Rival*> fitted;
    for (Rival* rival : order_)
      if (is_found(*rival)) fitted.push_back(rival);
    const PairRival* pair = best_pair();
    if (pair != nullptr && pair->log_odds > (fitted.empty() ? 0 : fitted.front()->log_odds)) {
      round_.added = true;
      round_.next = pair->second.state.settled(tools_.known());
      return;
    }
    if (fitted.empty()) return;
    camera_first(fitted, tools_);
    round_.added = true;
    round_.next = fitted[0]->state.settled(tools_.known());
    const auto second = std::find_if(fitted.begin(), fitted.end(), [&](const Rival* rival) {
      return rival->candidate->effect != fitted[0]->candidate->effect;
    });
    if (second == fitted.end()) return;
    round_.runner_up = (*second)->candidate->effect;
    round_.runner_up_setup = (*second)->state.settled(tools_.known()).setup;
  }

  void leave_out(Rival& rival) {
    rival.out_of_time = true;
    round_.not_tried.push_back(rival.candidate->effect);
  }

  /// Promises the most probable effect where there was no time to fit it: the table knows what its signature
  /// says. An effect may be a candidate several times, with other shapes.
  void promise_the_most_probable() {
    const auto less = [&](const Rival* a, const Rival* b) {
      return probability_among(rivals_, *a) < probability_among(rivals_, *b);
    };
    const auto most = std::max_element(order_.begin(), order_.end(), less);
    if (most == order_.end()) return;
    for (const Rival* rival : order_)  // by odds
      if (rival->candidate->effect == (*most)->candidate->effect && rival->weighed) {
        if (rival->out_of_time && !rival->fitted) round_.promised = promised_by(*rival, tools_.options());
        return;
      }
  }

  const DiagnosisState& state_;
  DiagnosisTools& tools_;
  const bool astray_;
  const DiagnosisState from_;  ///< about which the round looks
  const std::vector<Candidate> candidates_;
  const double searched_;  ///< number of effects that are looked for
  const bool rejected_;    ///< the state before
  const bool far_off_;     ///< so far that signatures say little
  double lowest_;          ///< chi2 of the best fit so far
  double nothing_gained_ = 0;
  std::unique_ptr<EffectScreen> screen_;
  std::vector<Rival> rivals_;
  std::vector<Rival*> order_;  ///< by odds
  std::vector<PairRival> pairs_;
  int tried_ = 0;
  SearchRound round_{{{{}, 0, 0}}, {}, {}, {}, false, {}, {}, "", {}};
};

}  // namespace

std::vector<Hypothesis> not_looked_at(const DiagnosisState& state, DiagnosisTools& tools,
                                      const std::vector<std::string>& seen_by_balance) {
  std::vector<Hypothesis> table{{{}, 0, 0}};
  const double all = static_cast<double>(tools.known().searched());
  for (const Candidate& candidate : open_candidates(state, tools, seen_by_balance))
    table.push_back({{candidate.effect}, prior_log_odds(candidate.prior.odds, all), 0});
  weigh(table);
  return table;
}

SearchRound search_round(const DiagnosisState& state, DiagnosisTools& tools,
                         const std::vector<std::string>& seen_by_balance) {
  return Round(state, tools, seen_by_balance).run();
}

}  // namespace shakedown
