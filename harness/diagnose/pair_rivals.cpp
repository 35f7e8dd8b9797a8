// SPDX-License-Identifier: MIT
#include "pair_rivals.hpp"

#include <algorithm>
#include <cmath>

#include "errors.hpp"
#include "rules.hpp"

namespace shakedown {

namespace {

/// Returns the rival of the best signature, null where none was weighed. It goes by signatures alone: where
/// restitutions imitate a pair, each of the two beside nothing may look worse than nothing.
const Rival* best_signature(const std::vector<Rival>& rivals) {
  const Rival* best = nullptr;
  for (const Rival& rival : rivals)
    if (rival.screened.weighed && !is_arithmetic(rival) &&
        (best == nullptr || rival.screened.log_evidence > best->screened.log_evidence))
      best = &rival;
  return best;
}

double log_odds_of_signature(const Rival& rival, double searched) {
  return rival.screened.log_evidence - rival.nothing_gained +
         prior_log_odds(rival.screened.seen.odds, searched);
}

}  // namespace

bool is_far_beyond(const PairRival& pair, const std::vector<Rival>& rivals) {
  const Rival* best = best_signature(rivals);
  if (best == nullptr) return false;
  const double single = best->screened.log_evidence;
  return pair.log_evidence - single > signatures_err_by(single);
}

std::vector<PairRival> pairs_beyond(const std::vector<Rival>& rivals, const std::vector<ScreenedPair>& pairs,
                                    const std::vector<Candidate>& candidates, double searched) {
  const auto rival_of = [&](std::size_t candidate) {
    return std::find_if(rivals.begin(), rivals.end(),
                        [&](const Rival& rival) { return rival.screened.candidate == candidate; });
  };
  const Rival* single = best_signature(rivals);
  if (single == nullptr) return {};
  const double best = log_odds_of_signature(*single, searched);
  std::vector<PairRival> list;
  for (const ScreenedPair& pair : pairs) {
    const auto first = rival_of(pair.first), second = rival_of(pair.second);
    if (first == rivals.end() || second == rivals.end()) continue;
    const std::vector<std::string>& alike = first->screened.look_alikes;
    if (std::find(alike.begin(), alike.end(), second->candidate->effect) != alike.end()) continue;
    PairRival one{*first, *second};
    one.first.screened.value = candidates[pair.first].value_of(pair.first_strength);
    one.second.screened.value = candidates[pair.second].value_of(pair.second_strength);
    one.log_evidence = pair.log_evidence;
    one.log_odds = pair.log_evidence - first->nothing_gained +
                   prior_log_odds(first->screened.seen.odds, searched) +
                   prior_log_odds(second->screened.seen.odds, searched);
    if (one.log_odds > best) list.push_back(std::move(one));
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const PairRival& a, const PairRival& b) { return a.log_odds > b.log_odds; });
  return list;
}

void fit_pair(PairRival& pair, const DiagnosisState& before, DiagnosisTools& tools, EffectScreen& screen,
              double lowest, Effort effort) {
  fit_rival(pair.second, with_rival(before, pair.first, tools), tools, screen, lowest, effort);
  if (!std::isfinite(pair.second.log_ratio)) throw BudgetSpent("no time to weigh the pair");
  pair.fitted = true;
  pair.first.state = pair.second.state;
  pair.first.log_ratio = pair.first.nothing_gained;  // the ratio of both is told with the second
  pair.first.fitted = true;
}

void weigh_pair(PairRival& pair, double searched) {
  if (!pair.fitted) return;
  weigh_rival(pair.first, searched);
  weigh_rival(pair.second, searched);
  pair.log_odds = pair.first.log_odds + pair.second.log_odds;
}

}  // namespace shakedown
