// SPDX-License-Identifier: MIT
// What the momentum balance weighs, in parts: the evidence of a noise, and which sets are weighed again.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "balance_problem.hpp"
#include "effects.hpp"
#include "pushed_box.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

PushedBox short_film() {
  PushedBox what;
  what.duration = 4;
  return what;
}

/// A short film of a box that nothing pushes, and what its regression refers to.
class SetsOfForces : public testing::Test {
 protected:
  const Experiment experiment_ = pushed_box(short_film(), 1);
  const Measurement measurement_ = measurement_of(pushed_setups(experiment_), experiment_);
  const BalanceProblem balance_{measurement_, all_effects()};
  SelectionProblem p_ = balance_.windows_of(0.5, 0.125);
};

// With no force in question and no nuisance the spring's stiffness alone is free.
TEST_F(SetsOfForces, EvidenceOfANoiseIsTheLikelihoodAveragedOverTheSpring) {
  p_.known.resize(1);
  p_.terms.resize(1);
  p_.problem.set_nuisances({});
  for (const double wander : {0.0, 1e-4, 1e-3}) {
    p_.problem.set_wander({wander, 0.3});
    p_.problem.set_covariance({});
    const Eigen::VectorXd column = columns_of(p_, {{0, 0}}).col(0);
    const Regression fit = regress(p_.problem.impulse(), columns_of(p_, {{0, 0}}));
    const double step = fit.error[0] / 10;
    double sum = 0;
    for (int k = -100; k <= 100; ++k) {
      const Eigen::VectorXd left = p_.problem.impulse() - (fit.strength[0] + k * step) * column;
      sum += step * std::exp((fit.chi2 - left.squaredNorm()) / 2);
    }
    const double averaged = std::log(sum) - (fit.chi2 + p_.problem.noise_penalty()) / 2;
    WITHIN(log_evidence_of_noise(p_) - averaged, -std::log(2 * std::numbers::pi) / 2, 1e-12, 5.7e-14)
        << wander;  // rounding of chi2
  }
}

TEST_F(SetsOfForces, WhatIsKnownOfTheSpringHoldsIt) {
  constexpr double change = 0.05;
  p_.problem.set_spring(change, 1e-9);
  const Regression held = regress(p_.problem.impulse(), columns_of(p_, {{0, 0}}));
  WITHIN(held.strength[0], change, 8e-12, 4.2e-13);
  p_.problem.set_spring(change, 1e3);
  const double told = regress(p_.problem.impulse(), columns_of(p_, {{0, 0}})).strength[0];
  p_.problem.set_spring(0, 0);
  WITHIN(told, regress(p_.problem.impulse(), columns_of(p_, {{0, 0}})).strength[0], 1e-13, 5.9e-15);
}

/// The place of a strength among the terms.
int place_of(const SelectionProblem& p, std::string_view key) {
  for (std::size_t term = 0; term < p.known.size(); ++term)
    if (p.known[term].key() == key) return static_cast<int>(term);
  ADD_FAILURE() << key;
  return 0;
}

/// Sets of the spring's frequency and one force each, all as probable as the first, which has another force.
/// Either may have either sign.
std::vector<BalanceHypothesis> alike(const SelectionProblem& p, std::size_t number) {
  std::vector<BalanceHypothesis> sets(number,
                                      {{{0, 0}, {place_of(p, "spring_cubic.coefficient"), 0}}, 0, 0, 0});
  sets.front().chosen[1].term = place_of(p, "constant_acceleration.acceleration.x");
  return sets;
}

TEST_F(SetsOfForces, OfThoseInQuestionEightAreWeighedAgain) {
  EXPECT_EQ(with_own_noise(p_, alike(p_, 8)).size(), 8u);
  EXPECT_EQ(with_own_noise(p_, alike(p_, 12)).size(), 8u);
}

TEST_F(SetsOfForces, WhatIsHopelessIsNotWeighedAgainUnlessItIsPartOfTheFirst) {
  std::vector<BalanceHypothesis> sets = alike(p_, 4);
  sets[1].log_odds = -13.9, sets[2].log_odds = -14.1, sets[3].log_odds = -14.1;
  sets[3].chosen.pop_back();
  EXPECT_EQ(with_own_noise(p_, sets).size(), 3u);
}

// A steady force lets no noise in: its set is as probable with its own noise as with that of all. The
// spring's frequency does, by its own error, and is in both.
TEST_F(SetsOfForces, ASetWhoseForceLetsNoNoiseInIsAsProbableWithItsOwn) {
  const int steady = place_of(p_, "constant_acceleration.acceleration.x");
  std::vector<BalanceHypothesis> both;
  for (const BalanceHypothesis& set : compare_sets(p_, {{0, 0}}))
    if (set.chosen.size() == 1 || (set.chosen.size() == 2 && set.chosen[1].term == steady))
      both.push_back(set);
  ASSERT_EQ(both.size(), 2u);
  const double odds = both[1].log_odds - both[0].log_odds;
  const std::vector<BalanceHypothesis> own = with_own_noise(p_, both);
  ASSERT_EQ(own.size(), 2u);
  EXPECT_EQ(own[0].chosen.size(), both[0].chosen.size());
  WITHIN(own[1].log_odds - own[0].log_odds, odds, 3e-6, 1.7e-7);
}

}  // namespace
}  // namespace shakedown
