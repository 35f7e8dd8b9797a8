// SPDX-License-Identifier: MIT
#include "evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "rules.hpp"

namespace shakedown {

bool contains(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

double log_odds_of(const StrengthSeen& seen, double candidates) {
  constexpr double impossible = -std::numeric_limits<double>::infinity();
  if (!std::isfinite(seen.gain) || !std::isfinite(seen.value) || !std::isfinite(seen.error) ||
      !std::isfinite(seen.odds) || !(seen.error > 0) || !(seen.typical > 0) || !(seen.odds > 0) ||
      (seen.one_sided && seen.value <= 0))
    return impossible;
  const double ratio = seen.value / seen.typical;
  const double density = (seen.one_sided ? 2 : 1) / (std::numbers::pi * seen.typical * (1 + ratio * ratio));
  // A strength known worse than the prior takes nothing of it away.
  const double share = std::min(1.0, density * seen.error * std::sqrt(2 * std::numbers::pi));
  return seen.gain / 2 + std::log(share) + prior_log_odds(seen.odds, candidates);
}

double prior_log_odds(double odds, double candidates) {
  const double each = std::min(0.5, rules::expected_effects * odds / std::max(1.0, candidates));
  return std::log(each / (1 - each));
}

void weigh(std::vector<Hypothesis>& table) {
  constexpr double impossible = -std::numeric_limits<double>::infinity();
  double most = impossible;
  for (Hypothesis& h : table) {
    if (!std::isfinite(h.log_odds)) h.log_odds = impossible;  // a NaN is no evidence
    most = std::max(most, h.log_odds);
  }
  if (most == impossible) {
    for (Hypothesis& h : table) h.probability = 0;
    return;
  }
  double sum = 0;
  for (const Hypothesis& h : table) sum += std::exp(h.log_odds - most);
  for (Hypothesis& h : table) h.probability = std::exp(h.log_odds - most) / sum;
  std::stable_sort(table.begin(), table.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.probability > b.probability; });
}

double probability_of_something_else(double p_value) {
  const double prior = rules::something_else / (1 - rules::something_else);
  double odds = prior;
  if (p_value < 1 / std::numbers::e) {
    const double p = std::max(p_value, 1e-300);
    odds /= -std::numbers::e * p * std::log(p);
  }
  return odds / (1 + odds);
}

std::vector<Hypothesis> with_something_else(std::vector<Hypothesis> table, double probability,
                                            std::vector<std::string> beside) {
  for (Hypothesis& h : table) h.probability *= 1 - probability;
  beside.emplace_back(unlisted_effect);
  table.push_back(
      {std::move(beside), std::log(probability / std::max(1 - probability, 1e-300)), probability});
  std::stable_sort(table.begin(), table.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.probability > b.probability; });
  return table;
}

std::vector<Hypothesis> with_something_else_or(const LeftOutEffects& left_out, std::vector<Hypothesis> table,
                                               double probability, std::vector<std::string> beside) {
  const double prior = rules::something_else / (1 - rules::something_else),
               odds = probability / std::max(1 - probability, 1e-300), raised = std::max(1.0, odds / prior);
  const auto has_one_of = [](const Hypothesis& h, const std::vector<std::string>& list) {
    return std::any_of(h.effects.begin(), h.effects.end(),
                       [&](const std::string& effect) { return contains(list, effect); });
  };
  const auto has_all_found = [&](const Hypothesis& h) {
    return std::all_of(left_out.found.begin(), left_out.found.end(),
                       [&](const std::string& effect) { return contains(h.effects, effect); });
  };
  double sum = 0, something_else = 0;
  for (Hypothesis& h : table) {
    const bool speaks = !has_one_of(h, left_out.not_fitted);
    something_else += h.probability * (speaks ? odds : prior);
    if (speaks &&
        (has_one_of(h, left_out.not_looked_at) || (has_one_of(h, left_out.not_beside) && has_all_found(h))))
      h.probability *= raised, h.log_odds += std::log(raised);
    sum += h.probability;
  }
  if (!(sum > 0)) return with_something_else(std::move(table), probability, std::move(beside));
  for (Hypothesis& h : table) h.probability /= sum;
  return with_something_else(std::move(table), something_else / (sum + something_else), std::move(beside));
}

std::vector<Hypothesis> answer_set(const std::vector<Hypothesis>& table) {
  std::vector<Hypothesis> set;
  double sum = 0;
  for (const Hypothesis& h : table) {
    if (sum >= rules::answer_set) break;
    set.push_back(h);
    sum += h.probability;
  }
  return set;
}

namespace {

/// Adds the hypothesis, or its probability where the same set is there already.
void add_to(std::vector<Hypothesis>& table, Hypothesis hypothesis) {
  const auto same = std::find_if(table.begin(), table.end(), [&](const Hypothesis& other) {
    return std::is_permutation(other.effects.begin(), other.effects.end(), hypothesis.effects.begin(),
                               hypothesis.effects.end());
  });
  if (same == table.end()) {
    table.push_back(std::move(hypothesis));
    return;
  }
  const double most = std::max(same->log_odds, hypothesis.log_odds),
               least = std::min(same->log_odds, hypothesis.log_odds);
  if (std::isfinite(most)) same->log_odds = most + std::log1p(std::exp(least - most));
  same->probability += hypothesis.probability;
}

void sort_by_probability(std::vector<Hypothesis>& table) {
  std::stable_sort(table.begin(), table.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.probability > b.probability; });
}

}  // namespace

std::vector<Hypothesis> combined(const std::vector<Hypothesis>& a, const std::vector<Hypothesis>& b) {
  std::vector<Hypothesis> both;
  for (const Hypothesis& one : a)
    for (const Hypothesis& other : b) {
      Hypothesis h{one.effects, one.log_odds + other.log_odds, one.probability * other.probability};
      for (const std::string& effect : other.effects)
        if (!contains(h.effects, effect)) h.effects.push_back(effect);
      add_to(both, std::move(h));
    }
  sort_by_probability(both);
  return both;
}

std::vector<Hypothesis> taken_back(const std::vector<Hypothesis>& table, const std::string& effect,
                                   double log_odds) {
  const double kept = 1 / (1 + std::exp(-log_odds));
  std::vector<Hypothesis> rest;
  for (const Hypothesis& h : table) {
    Hypothesis without = h;
    std::erase(without.effects, effect);
    if (without.effects.size() < h.effects.size()) {
      add_to(rest, {h.effects, h.log_odds + std::log(kept), h.probability * kept});
      without.log_odds += std::log1p(-kept), without.probability *= 1 - kept;
    }
    add_to(rest, std::move(without));
  }
  sort_by_probability(rest);
  return rest;
}

double probability_of_something(const std::vector<Hypothesis>& table) {
  double sum = 0;
  for (const Hypothesis& h : table)
    if (!h.effects.empty()) sum += h.probability;
  return sum;
}

std::vector<std::string> ties_of(const std::vector<Hypothesis>& set) {
  std::vector<std::string> ties;
  if (set.empty()) return ties;
  for (const Hypothesis& h : set)
    for (const std::string& effect : h.effects)
      if (!contains(set.front().effects, effect) && !contains(ties, effect)) ties.push_back(effect);
  return ties;
}

TieKind kind_of(const std::vector<std::string>& ties, const std::vector<std::string>& found,
                const std::vector<Hypothesis>& set) {
  TieKind kind;
  for (const Hypothesis& h : set) {
    const auto has = [&](const std::string& effect) { return contains(h.effects, effect); };
    if (std::none_of(ties.begin(), ties.end(), has)) continue;
    (std::all_of(found.begin(), found.end(), has) ? kind.beside : kind.instead) = true;
  }
  return kind;
}

}  // namespace shakedown
