// SPDX-License-Identifier: MIT
// Rivals of one round weighed against each other, by hand.
#include <gtest/gtest.h>

#include <numbers>

#include "rival.hpp"
#include "rules.hpp"

using namespace shakedown;

namespace {

constexpr double known = 30;  // effects

Candidate named(const std::string& effect) {
  Candidate candidate;
  candidate.effect = effect;
  return candidate;
}

/// Fitted: what it leaves of two features of unit variance, and the p-value of its fit.
Rival fitted(const Candidate& candidate, double odds, double log_odds, const Eigen::Vector2d& left,
             double p_value = 0.5) {
  Rival rival{&candidate, {}};
  rival.screened.seen.odds = odds;
  rival.log_odds = log_odds;
  rival.log_ratio = log_odds;
  rival.fitted = true;
  Refit& fit = rival.state.fit;
  fit.p_value = p_value;
  fit.covariances = {Eigen::Matrix2d::Identity()};
  fit.runs.resize(1);
  fit.runs.front().residual = left;
  return rival;
}

/// Odds of a difference of so much chi2 between two fits.
double averaged(double chi2) {
  const double error = rules::emulator_noise / 2;
  return chi2 / 2 / std::sqrt(1 + std::numbers::pi / 8 * error * error);
}

}  // namespace

TEST(Rival, FitsThatHoldAreWeighedByWhatTheyLeave) {
  const Candidate first = named("a"), second = named("b");
  // Over a model that is wrong the first seemed 200 better.
  std::vector<Rival> rivals{fitted(first, 1, 2600, {3, 1}), fitted(second, 1, 2400, {1, 0})};
  weigh_beside_the_best(rivals, known);
  EXPECT_DOUBLE_EQ(rivals[0].log_odds, 2600);
  EXPECT_NEAR(rivals[1].log_odds - rivals[0].log_odds, averaged(9), 1e-12);
}

TEST(Rival, OfTwoThatLeaveTheSameTheOneMoreProbableBeforehandLeads) {
  const Candidate first = named("a"), second = named("b");
  std::vector<Rival> rivals{fitted(first, 0.1, 2600, {1, 1}), fitted(second, 1, 2400, {1, 1})};
  weigh_beside_the_best(rivals, known);
  EXPECT_NEAR(rivals[1].log_odds - rivals[0].log_odds, prior_log_odds(1, known) - prior_log_odds(0.1, known),
              1e-12);
}

TEST(Rival, WhatTheDataRejectKeepsItsOdds) {
  const Candidate first = named("a"), second = named("b");
  std::vector<Rival> rivals{fitted(first, 1, 2600, {1, 1}), fitted(second, 1, 2400, {0, 0}, 0.001)};
  weigh_beside_the_best(rivals, known);
  EXPECT_DOUBLE_EQ(rivals[1].log_odds, 2400);
}
