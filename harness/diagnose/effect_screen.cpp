// SPDX-License-Identifier: MIT
#include "effect_screen.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "effort.hpp"
#include "errors.hpp"
#include "known_effects.hpp"
#include "rules.hpp"
#include "screen_simulations.hpp"

namespace shakedown {

namespace {

void weigh_by(const Signature& signature, const Candidate& candidate, ScreenedEffect& effect) {
  const StrengthPosterior found = posterior_of(signature, candidate.strengths);
  effect.weighed = true;
  effect.log_evidence = found.log_evidence;
  effect.gain = found.gain;
  effect.share_seen = found.share_seen;
  effect.value = candidate.value_of(found.strength);
  effect.seen.gain = found.gain;
  effect.seen.value = effect.seen.one_sided ? std::abs(found.strength) : found.strength;
  effect.seen.error = found.error;
}

void name_look_alikes(const std::vector<Eigen::VectorXd>& changes, std::vector<ScreenedEffect>& list) {
  constexpr double alike = 0.9;  // cosine: a fifth of the square of one is not the other's
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t b = 0; b < list.size(); ++b) {
      if (a == b || list[a].effect == list[b].effect || changes[a].size() == 0 || changes[b].size() == 0)
        continue;
      const double cosine =
          changes[a].dot(changes[b]) / std::max(1e-300, changes[a].norm() * changes[b].norm());
      if (std::abs(cosine) > alike) list[a].look_alikes.push_back(list[b].effect);
    }
}

}  // namespace

bool is_left_open(const ScreenedEffect& effect, double most, double searched) {
  if (!effect.weighed) return false;
  const double doubted = std::log(rules::doubtful);
  // What the noise of a glance has taken off the gain comes back with more simulations.
  const double share = std::max<double>(effect.share_seen, effort::glance_tells),
               could_be = effect.log_evidence + effect.gain / 2 * (1 / share - 1);
  return could_be > effort::glance_sees * most + doubted &&
         could_be + prior_log_odds(effect.seen.odds, searched) > doubted;
}

bool is_undecided(const ScreenedEffect& effect, double searched) {
  const double log_odds = effect.log_evidence + prior_log_odds(effect.seen.odds, searched);
  return effect.share_seen < effort::well_seen && log_odds < -std::log(rules::doubtful);
}

EffectScreen::EffectScreen(std::vector<MeasuredFeatures> measured, std::vector<Knob> fitted,
                           const Workshop& workshop, const ScreenEffort& effort, int first_run,
                           const ScreenStart& start)
    : simulations_(std::make_unique<ScreenSimulations>(std::move(measured), std::move(fitted), workshop,
                                                       effort, first_run, start)),
      effort_(effort),
      searched_(workshop.known.searched()) {}

EffectScreen::~EffectScreen() = default;

double EffectScreen::log_likelihood_ratio(const std::vector<MeasuredFeatures>& other,
                                          const std::vector<Knob>& values, int count) {
  return simulations_->log_likelihood_ratio(other, values, count);
}

std::vector<ScreenedPair> EffectScreen::pairs(const std::vector<Candidate>& candidates) const {
  std::vector<ScreenedPair> list;
  for (auto a = signatures_.begin(); a != signatures_.end(); ++a)
    for (auto b = std::next(a); b != signatures_.end(); ++b) {
      const Candidate &first = candidates[a->first], &second = candidates[b->first];
      if (first.effect == second.effect) continue;
      const PairPosterior found = posterior_of(a->second, first.strengths, b->second, second.strengths);
      if (std::isfinite(found.log_evidence))
        list.push_back({a->first, b->first, found.first, found.second, found.log_evidence});
    }
  std::stable_sort(list.begin(), list.end(), [](const ScreenedPair& a, const ScreenedPair& b) {
    return a.log_evidence > b.log_evidence;
  });
  return list;
}

struct EffectScreen::Weighed {
  ScreenedEffect effect;
  Looked looked;
  Eigen::VectorXd change{};  ///< at the strength found
};

void EffectScreen::weigh_again(const Candidate& candidate, Weighed& one) {
  const Signature signature = simulations_->signature_of(one.looked);
  weigh_by(signature, candidate, one.effect);
  if (!one.looked.exact) signatures_.insert_or_assign(one.effect.candidate, signature);
  one.change = signature.change(candidate.strength_of(one.effect.value));
}

bool EffectScreen::may_be_missing(const ScreenedEffect& effect, double best) const {
  return is_left_open(effect, best, static_cast<double>(searched_));
}

bool EffectScreen::glance(const Candidate& candidate, Weighed& one) {
  simulations_->look_at_the_middle(candidate, effort_.glance, one.looked);
  if (!one.looked.levels.empty()) weigh_again(candidate, one);
  // It is judged beside nothing alone, while the best one is not known.
  if (!one.looked.whole &&
      (one.looked.levels.empty() || (!effort_.middle_alone && may_be_missing(one.effect, 0)))) {
    simulations_->look(candidate, effort_.glance, one.looked);
    if (!one.looked.levels.empty()) weigh_again(candidate, one);
  }
  return !one.looked.levels.empty();
}

void EffectScreen::look_closer(const std::vector<Candidate>& candidates, std::vector<Weighed>& list) {
  std::stable_sort(list.begin(), list.end(), [](const Weighed& a, const Weighed& b) {
    return a.effect.log_evidence > b.effect.log_evidence;
  });
  const auto look_at_open_ones = [&](const LevelEffort& effort, bool undecided) {
    double most = 0;
    for (const Weighed& one : list)
      if (one.effect.weighed) most = std::max(most, one.effect.log_evidence);
    for (Weighed& one : list) {
      if (!one.looked.whole || one.looked.exact || !may_be_missing(one.effect, most)) continue;
      if (undecided && !is_undecided(one.effect, static_cast<double>(searched_))) continue;
      const Candidate& candidate = candidates[one.effect.candidate];
      simulations_->look(candidate, effort, one.looked);
      weigh_again(candidate, one);
    }
  };
  look_at_open_ones(effort_.look, false);
  look_at_open_ones(effort_.decide, true);
}

Screening EffectScreen::weigh(const std::vector<Candidate>& candidates) {
  signatures_.clear();
  std::vector<Weighed> list;
  Screening screening;
  bool spent = false;
  for (const std::size_t c : by_odds_for_cost(candidates)) {
    const Candidate& candidate = candidates[c];
    const double middle = candidate.levels[candidate.levels.size() / 2].value;
    Weighed one{{c, candidate.effect, 0, middle, 0, candidate.prior}, {}};
    if (!spent) try {
        if (!glance(candidate, one)) {
          screening.left_out.push_back({candidate.effect, one.looked.reason});
          continue;
        }
      } catch (const BudgetSpent&) {
        spent = true;
        // Its middle level alone says nothing against an effect that other levels may speak for.
        if (one.effect.log_evidence < 0 && may_be_missing(one.effect, 0)) {
          one.effect.weighed = false;
          signatures_.erase(c);
        }
      }
    list.push_back(std::move(one));
  }
  if (!spent) try {
      look_closer(candidates, list);
    } catch (const BudgetSpent&) {  // a glance has to do
    }
  std::stable_sort(list.begin(), list.end(),
                   [](const Weighed& a, const Weighed& b) { return a.effect.gain > b.effect.gain; });
  std::vector<Eigen::VectorXd> changes;
  for (Weighed& one : list) {
    screening.list.push_back(std::move(one.effect));
    changes.push_back(std::move(one.change));
  }
  name_look_alikes(changes, screening.list);
  return screening;
}

}  // namespace shakedown
