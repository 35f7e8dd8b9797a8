// SPDX-License-Identifier: MIT
// What a judge can reach who knows everything but what is hidden.
#include "ideal_judge.hpp"
#include "within.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace shakedown;

namespace {

constexpr int draws = 2000;

}  // namespace

TEST(IdealJudge, WhatLeavesNoTraceKeepsItsPrior) {
  // Three effects that nobody can see: nothing keeps one half, each a sixth.
  const std::vector<std::vector<double>> none(3, std::vector<double>(3, 0.0));
  WITHIN(ideal_log_score(none, {}, 0, 10, 1), std::log(2), 9e-7, 4.7e-8);
  WITHIN(ideal_log_score(none, 1, 1, 10, 1), std::log(6), 1e-6, 5.8e-8);
}

TEST(IdealJudge, AStrongTraceIsNamedAndAWeakOneIsNot) {
  const std::vector<std::vector<double>> apart{{100, 0}, {0, 100}};
  EXPECT_LT(ideal_log_score(apart, 0, 1, draws, 1), 0.05);
  EXPECT_GT(ideal_log_score(apart, 0, 0.1, draws, 1), 1.5);
  double last = 10;
  for (const double strength : {0.1, 0.2, 0.4, 0.8}) {
    const double score = ideal_log_score(apart, 0, strength, draws, 1);
    EXPECT_LT(score, last);
    last = score;
  }
}

TEST(IdealJudge, TwoThatLookAlikeShareTheProbability) {
  const std::vector<std::vector<double>> alike{{100, 100}, {100, 100}};
  WITHIN(ideal_log_score(alike, 0, 1, draws, 1), std::log(2), 4e-6, 2.5e-7);
}

TEST(IdealJudge, ItsProbabilitiesAreHonest) {
  // With truths drawn as it takes them to be, its score of nothing and of effects is the entropy: no other is
  // better. Here only that it is seldom sure where nothing is hidden: -ln P is small on the average.
  const std::vector<std::vector<double>> apart{{25, 5}, {5, 25}};
  EXPECT_LT(ideal_log_score(apart, {}, 0, draws, 1), std::log(2));
}
