// SPDX-License-Identifier: MIT
// From gains to probabilities, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "evidence.hpp"
#include "rules.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A strength seen at so many errors from nothing; its scale beforehand is 1.
StrengthSeen seen_at(double value, double error, bool one_sided = false) {
  return {std::pow(value / error, 2), value, error, 1, one_sided, 1};
}

/// ln of the likelihood over that of nothing, averaged over the prior: trapezium rule about the maximum,
/// whose error for a bell is far below 1e-6.
double integrated(const StrengthSeen& seen) {
  constexpr int steps = 20000;
  const double low = std::max(seen.one_sided ? 0 : -infinite, seen.value - 12 * seen.error),
               step = (seen.value + 12 * seen.error - low) / steps;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double strength = low + i * step, ratio = strength / seen.typical;
    const double prior = (seen.one_sided ? 2 : 1) / (std::numbers::pi * seen.typical * (1 + ratio * ratio));
    sum += prior * step * std::exp(-std::pow((strength - seen.value) / seen.error, 2) / 2);
  }
  return seen.gain / 2 + std::log(sum);
}

double sum_of(const std::vector<Hypothesis>& table) {
  return std::accumulate(table.begin(), table.end(), 0.0,
                         [](double sum, const Hypothesis& h) { return sum + h.probability; });
}

/// Nothing, one effect, the other, both.
std::vector<Hypothesis> weighed_table(double of_a, double of_b) {
  std::vector<Hypothesis> table{{{}, 0, 0}, {{"a"}, of_a, 0}, {{"b"}, of_b, 0}};
  weigh(table);
  return table;
}

TEST(Evidence, IsTheLikelihoodAveragedOverThePrior) {
  // Laplace leaves out the curvature of the prior: by its second derivative up to (error/typical)^2 in ln.
  for (const bool one_sided : {false, true})
    for (const double error : {0.003, 0.03, 0.1, 0.3})
      for (const double sigmas : {4.0, 6.0, 12.0, 30.0}) {
        const StrengthSeen seen = seen_at(sigmas * error, error, one_sided);
        const double prior = std::log(rules::expected_effects / 20 / (1 - rules::expected_effects / 20));
        WITHIN((log_odds_of(seen, 20) - integrated(seen) - prior) / (1.5 * error * error + 1e-4), 0, 1, 0.6)
            << sigmas << " errors of " << error;
      }
}

TEST(Evidence, AStrengthKnownWorseThanThePriorTakesNothingOfIt) {
  const StrengthSeen vague = seen_at(1, 50);
  const double prior = std::log(0.05 / 0.95);
  WITHIN(log_odds_of(vague, 10), vague.gain / 2 + prior, 1e-14, 6.6e-16);
  // ... and gains no more than the likelihood at its maximum; the average over the prior is near nothing's.
  EXPECT_LT(std::abs(log_odds_of(vague, 10) - prior - integrated(vague)), 0.1);
}

TEST(Evidence, ACandidateAmongManyIsLessLikelyBeforehand) {
  const StrengthSeen seen = seen_at(0.5, 0.1);
  const auto prior = [](double candidates) {
    return std::log(rules::expected_effects / candidates / (1 - rules::expected_effects / candidates));
  };
  WITHIN(log_odds_of(seen, 5) - log_odds_of(seen, 50), prior(5) - prior(50), 3e-14, 1.8e-15);
  StrengthSeen rare = seen;
  rare.odds = 0.1;
  WITHIN(log_odds_of(seen, 50), log_odds_of(rare, 5), 3e-14, 1.8e-15);
}

TEST(Evidence, TheWrongSignIsImpossible) {
  EXPECT_EQ(log_odds_of(seen_at(-0.5, 0.1, true), 10), -infinite);
  EXPECT_TRUE(std::isfinite(log_odds_of(seen_at(-0.5, 0.1, false), 10)));
}

TEST(Evidence, WhatIsNoNumberIsImpossibleAndNeverAProbability) {
  const StrengthSeen good = seen_at(0.5, 0.1);
  for (const double bad : {std::nan(""), infinite, -infinite})
    for (double StrengthSeen::*field : {&StrengthSeen::gain, &StrengthSeen::value, &StrengthSeen::error,
                                        &StrengthSeen::typical, &StrengthSeen::odds}) {
      StrengthSeen seen = good;
      seen.*field = bad;
      EXPECT_EQ(log_odds_of(seen, 10), -infinite) << bad;
    }
  for (const double bad : {0.0, -1.0}) {
    StrengthSeen seen = good;
    seen.error = bad;
    EXPECT_EQ(log_odds_of(seen, 10), -infinite) << bad;
  }
  std::vector<Hypothesis> table = weighed_table(-infinite, 1);
  EXPECT_EQ(table.back().probability, 0);
  WITHIN(sum_of(table), 1, 4e-15, 2.3e-16);
  table = weighed_table(std::nan(""), 1);
  WITHIN(sum_of(table), 1, 4e-15, 2.3e-16);
}

TEST(Evidence, AFavouriteAmongFewStaysAProbability) {
  StrengthSeen favourite = seen_at(0.5, 0.1);
  favourite.odds = 4;  // half an effect, four times as likely: more than one
  EXPECT_FALSE(std::isnan(log_odds_of(favourite, 1)));
}

TEST(Evidence, WeighedHypothesesSumToOneAndTheMostProbableComesFirst) {
  const std::vector<Hypothesis> table = weighed_table(3, 800);  // exp(800) is no double
  WITHIN(sum_of(table), 1, 4e-15, 2.3e-16);
  EXPECT_EQ(table.front().effects, std::vector<std::string>{"b"});
  WITHIN(table.front().probability, 1, 4e-15, 2.3e-16);
  const std::vector<Hypothesis> even = weighed_table(0, std::log(2.0));
  WITHIN(even[0].probability, 0.5, 2e-15, 1.2e-16);
  WITHIN(even[1].probability, 0.25, 1e-15, 5.6e-17);
  EXPECT_TRUE(even[1].effects.empty());  // of equals the first stays first
  WITHIN(probability_of_something(even), 0.75, 3e-15, 1.7e-16);
  std::vector<Hypothesis> none;
  weigh(none);
  EXPECT_TRUE(none.empty());
}

TEST(Evidence, TheAnswerIsTheFewestThatHold95Percent) {
  const std::vector<Hypothesis> table{{{"a"}, 0, 0.6}, {{"b"}, 0, 0.3}, {{}, 0, 0.06}, {{"c"}, 0, 0.04}};
  EXPECT_EQ(answer_set(table).size(), 3u);
  EXPECT_EQ(answer_set({{{"a"}, 0, 0.96}, {{}, 0, 0.04}}).size(), 1u);
  EXPECT_TRUE(answer_set({}).empty());
}

TEST(Evidence, IndependentTablesMultiply) {
  const std::vector<Hypothesis> a = weighed_table(2, 1), b = weighed_table(0.5, -1), both = combined(a, b);
  ASSERT_EQ(both.size(), 4u);
  WITHIN(sum_of(both), 1, 4e-15, 2.3e-16);
  for (std::size_t i = 1; i < both.size(); ++i) EXPECT_LE(both[i].probability, both[i - 1].probability);
  for (const Hypothesis& h : both)  // an effect of both tables stands once
    EXPECT_FALSE(h.effects.size() == 2 && h.effects[0] == h.effects[1]);
  const auto nothing =
      std::find_if(both.begin(), both.end(), [](const auto& h) { return h.effects.empty(); });
  WITHIN(nothing->probability, (1 - probability_of_something(a)) * (1 - probability_of_something(b)), 6e-16,
         3.2e-17);
}

TEST(Evidence, EqualSetsOfTwoTablesAreOneHypothesis) {
  std::vector<Hypothesis> a{{{}, 0, 0}, {{"a"}, 2, 0}}, b{{{}, 0, 0}, {{"a"}, -1, 0}, {{"b"}, 1, 0}};
  weigh(a), weigh(b);
  const std::vector<Hypothesis> both = combined(a, b);
  ASSERT_EQ(both.size(), 4u);  // none, a, b, a and b
  WITHIN(sum_of(both), 1, 4e-15, 2.3e-16);
  const auto of_a = std::find_if(both.begin(), both.end(),
                                 [](const auto& h) { return h.effects == std::vector<std::string>{"a"}; });
  const double weights = (1 + std::exp(2)) * (1 + std::exp(-1) + std::exp(1));
  WITHIN(of_a->probability, (std::exp(2) + std::exp(-1) + std::exp(1)) / weights, 1e-15, 6.8e-17);
  WITHIN(of_a->log_odds, std::log(std::exp(2) + std::exp(-1) + std::exp(1)), 1e-14, 5.3e-16);
}

// Nothing is left to divide by.
TEST(Evidence, ATableWithoutProbabilityLeavesSomethingInNoListAlone) {
  EXPECT_EQ(with_something_else_or({{"b"}, {}}, {}, 0.3).front().probability, 0.3);
  const std::vector<Hypothesis> table = with_something_else_or({{"b"}, {}}, {{{"a"}, -1000, 0}}, 0.3);
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[0].probability, 0.3);
  EXPECT_EQ(table[1].probability, 0);
}

// The pair is the most probable product, and the two ways to have the first effect alone come to more.
TEST(Evidence, WhatEqualSetsAddUpToSaysWhichGoesFirst) {
  std::vector<Hypothesis> a{{{}, 0, 0}, {{"a"}, 2, 0}}, b{{{}, 0, 0}, {{"a"}, 0.9, 0}, {{"b"}, 1, 0}};
  weigh(a), weigh(b);
  const std::vector<Hypothesis> both = combined(a, b);
  ASSERT_GE(both.size(), 2u);
  EXPECT_EQ(both[0].effects, std::vector<std::string>{"a"});
  EXPECT_EQ(both[1].effects.size(), 2u);
}

TEST(Evidence, WhatIsTakenBackLeavesTheTableBecauseTheTableSaysSo) {
  const std::vector<Hypothesis> table{
      {{"a", "b"}, 5, 0.7}, {{"a"}, 3, 0.2}, {{"b"}, 0, 0.06}, {{}, -1, 0.04}};
  const double kept = 0.02, odds = std::log(kept / (1 - kept));
  const std::vector<Hypothesis> rest = taken_back(table, "a", odds);
  ASSERT_EQ(rest.size(), 4u);
  WITHIN(sum_of(rest), 1, 4e-15, 2.3e-16);
  EXPECT_EQ(rest.front().effects, std::vector<std::string>{"b"});
  WITHIN(rest.front().probability, 0.7 * 0.98 + 0.06, 3e-15, 1.7e-16);
  double with = 0;
  for (const Hypothesis& h : rest)
    if (std::find(h.effects.begin(), h.effects.end(), "a") != h.effects.end()) with += h.probability;
  WITHIN(with, 0.9 * kept, 8e-17, 4e-18);
}

TEST(Evidence, WhereAllIsImpossibleNothingIsProbable) {
  std::vector<Hypothesis> table{{{"a"}, -std::numeric_limits<double>::infinity(), 0.5},
                                {{}, std::nan(""), 0.5}};
  weigh(table);
  for (const Hypothesis& h : table) EXPECT_EQ(h.probability, 0);
}

TEST(Evidence, WhatIsTakenBackLeavesItsOddsToTheRest) {
  const double odds = 1.5, kept = 1 / (1 + std::exp(-odds));
  const std::vector<Hypothesis> rest = taken_back({{{"a", "b"}, 2, 0.9}}, "a", odds);
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(rest[0].effects, (std::vector<std::string>{"a", "b"}));
  EXPECT_DOUBLE_EQ(rest[0].log_odds, 2 + std::log(kept));
  EXPECT_EQ(rest[1].effects, std::vector<std::string>{"b"});
  EXPECT_DOUBLE_EQ(rest[1].log_odds, 2 + std::log(1 - kept));
}

TEST(Evidence, SomethingInNoListIsWeighedByThePValue) {
  const double prior = rules::something_else;
  for (const double p_value : {0.9, 0.5, 0.37})  // above 1/e a p-value says nothing against a model
    WITHIN(probability_of_something_else(p_value), prior, 9e-17, 4.5e-18);
  WITHIN(probability_of_something_else(std::nan("")), prior, 9e-17, 4.5e-18);
  WITHIN(probability_of_something_else(0.01), 0.14, 3e-3, 1.8e-4);  // odds of 1/49 over 0.125
  EXPECT_GT(probability_of_something_else(1e-6), 0.99);
  EXPECT_LE(probability_of_something_else(0), 1);
  const std::vector<Hypothesis> table = with_something_else({{{"a"}, 3, 0.8}, {{}, 0, 0.2}}, 0.5);
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table.front().effects, std::vector<std::string>{unlisted_effect});
  WITHIN(sum_of(table), 1, 4e-15, 2.3e-16);
  WITHIN(table[1].probability, 0.4, 1e-15, 8.9e-17);
}

// A model that fails while half of the list was not looked at: what was not may be it as well.
TEST(Evidence, WhatWasNotLookedAtIsRaisedWithSomethingInNoList) {
  const std::vector<Hypothesis> table{{{}, 0, 0.7}, {{"a"}, 0, 0.1}, {{"b"}, 0, 0.1}, {{"c"}, 0, 0.1}};
  const double certain = 1 - 1e-9;
  const std::vector<Hypothesis> all_looked_at = with_something_else_or({}, table, certain);
  WITHIN(sum_of(all_looked_at), 1, 4e-15, 2.3e-16);
  EXPECT_EQ(all_looked_at.front().effects, std::vector<std::string>{unlisted_effect});
  EXPECT_GT(all_looked_at.front().probability, 0.999);
  const std::vector<Hypothesis> half = with_something_else_or({{"b", "c"}, {}}, table, certain);
  WITHIN(sum_of(half), 1, 4e-15, 2.3e-16);
  // Among what may be, prior odds decide: 0.1 and 0.1 to 0.02 / 0.98.
  const double unlisted = 0.02 / 0.98;
  for (const Hypothesis& h : half)
    WITHIN(h.probability,
           h.effects == std::vector<std::string>{unlisted_effect} ? unlisted / (0.2 + unlisted)
           : h.effects == std::vector<std::string>{"b"} || h.effects == std::vector<std::string>{"c"}
               ? 0.1 / (0.2 + unlisted)
               : 0,
           1e-9, 6.5e-11);
  // A model that holds gives nothing away.
  WITHIN(with_something_else_or({{"b", "c"}, {}}, table, 0.02).front().probability, 0.7 * 0.98, 3e-15,
         1.6e-16);
}

TEST(Evidence, APValueSaysNothingAgainstAnEffectThatWasWeighedAndNotFitted) {
  // The signature of b holds 97 %; there was no time to fit it, so that the final model, without it, fails.
  const std::vector<Hypothesis> table{{{"b"}, 0, 0.97}, {{}, 0, 0.02}, {{"c"}, 0, 0.01}};
  const double fails = 0.9, prior = rules::something_else / (1 - rules::something_else);
  const std::vector<Hypothesis> weighed = with_something_else_or({{}, {"b"}}, table, fails);
  EXPECT_DOUBLE_EQ(sum_of(weighed), 1);
  const double odds = 0.97 * prior + 0.03 * fails / (1 - fails);
  EXPECT_EQ(weighed.front().effects, std::vector<std::string>{"b"});
  EXPECT_DOUBLE_EQ(weighed.front().probability, 0.97 / (1 + odds));
  EXPECT_DOUBLE_EQ(weighed[1].probability, odds / (1 + odds));
  // Nor is it raised as what was not looked at is.
  const std::vector<Hypothesis> both = with_something_else_or({{"c"}, {"b"}}, table, fails);
  EXPECT_DOUBLE_EQ(sum_of(both), 1);
  double of_b = 0, of_c = 0;
  for (const Hypothesis& h : both) {
    if (h.effects == std::vector<std::string>{"b"}) of_b = h.probability;
    if (h.effects == std::vector<std::string>{"c"}) of_c = h.probability;
  }
  EXPECT_DOUBLE_EQ(of_c / of_b, 0.01 / 0.97 * fails / (1 - fails) / prior);
}

TEST(Evidence, TiesAreWhatItMayBeInstead) {
  EXPECT_EQ(ties_of({{{"a"}, 0, 0.5}, {{"a", "b"}, 0, 0.2}, {{"c"}, 0, 0.2}, {{"b"}, 0, 0.06}}),
            (std::vector<std::string>{"b", "c"}));
  EXPECT_TRUE(ties_of({{{"a"}, 0, 0.9}, {{}, 0, 0.06}}).empty());
  EXPECT_TRUE(ties_of({}).empty());
}

}  // namespace
