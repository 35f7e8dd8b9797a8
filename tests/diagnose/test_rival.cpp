// SPDX-License-Identifier: MIT
// Rivals of one round weighed against each other, by hand.
#include <gtest/gtest.h>

#include <numbers>

#include "distributions.hpp"
#include "effects.hpp"
#include "rival.hpp"
#include "rules.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double known = 30;  // effects

Candidate named(const std::string& effect) {
  Candidate candidate;
  candidate.effect = effect;
  candidate.knobs.resize(1);
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
  WITHIN(rivals[1].log_odds - rivals[0].log_odds, averaged(9), 1e-12, 5e-14);
}

TEST(Rival, OfTwoThatLeaveTheSameTheOneMoreProbableBeforehandLeads) {
  const Candidate first = named("a"), second = named("b");
  std::vector<Rival> rivals{fitted(first, 0.1, 2600, {1, 1}), fitted(second, 1, 2400, {1, 1})};
  weigh_beside_the_best(rivals, known);
  WITHIN(rivals[1].log_odds - rivals[0].log_odds, prior_log_odds(1, known) - prior_log_odds(0.1, known),
         1e-12, 9.8e-14);
}

// A film of dry friction: its law with yielding has 50 more by signatures that err by 250, and no time is
// left.
TEST(Rival, WhatWasNotFittedIsWeighedBySignaturesThatErr) {
  const Candidate first = named("dry"), second = named("yielding");
  std::vector<Rival> rivals{fitted(first, 1, 2600, {1, 1}), {&second, {}}};
  rivals[0].screened.weighed = rivals[1].screened.weighed = true;
  rivals[0].screened.log_evidence = 2557, rivals[1].screened.log_evidence = 2608;
  rivals[1].screened.seen.odds = 0.1;
  weigh_rival(rivals[1], known);
  EXPECT_GT(rivals[1].log_odds, rivals[0].log_odds);
  weigh_beside_the_best(rivals, known);
  const double less_likely = prior_log_odds(0.1, known) - prior_log_odds(1, known);
  EXPECT_GT(rivals[1].log_odds - rivals[0].log_odds, less_likely);
  EXPECT_LT(rivals[1].log_odds - rivals[0].log_odds, less_likely + 1);
}

TEST(Rival, OfSignaturesAsGoodWhatWasMoreProbableBeforehandIsFittedFirst) {
  const Candidate first = named("dry"), second = named("yielding"), third = named("other");
  std::vector<Rival> rivals{fitted(second, 0.1, 2608, {1, 1}), fitted(first, 1, 2557, {1, 1}),
                            fitted(third, 2, 2000, {1, 1})};
  EXPECT_EQ(first_to_fit({&rivals[0], &rivals[1], &rivals[2]}), &rivals[1]);
  EXPECT_EQ(first_to_fit({&rivals[0], &rivals[2]}), &rivals[0]);
  rivals[2].screened.seen.odds = 0.1, rivals[2].log_odds = 2600;  // as probable beforehand as the first
  EXPECT_EQ(first_to_fit({&rivals[0], &rivals[2]}), &rivals[0]);
  EXPECT_EQ(first_to_fit({}), nullptr);
}

namespace {

Rival shortly_fitted(const Candidate& candidate, double chi2, double without) {
  Rival rival{&candidate, {}};
  rival.short_chi2 = rival.short_own_chi2 = rival.short_deviance = chi2;
  rival.chi2_without = without;
  return rival;
}

}  // namespace

// Two films, what the model without left 3391 and 2561: in the one a restitution that falls with speed is
// alone, in the other unequal grains seem to leave less.
TEST(Rival, ThoseWhoseShortFitsMakeTheDataLikelyAreInQuestion) {
  const Candidate arc = named("arc"), law = named("law"), unequal = named("unequal"), other = named("other");
  std::vector<Rival> alone{shortly_fitted(arc, 4265, 3391), shortly_fitted(law, 693, 3391), {&other, {}}};
  EXPECT_EQ(in_question(alone), std::vector<Rival*>{&alone[1]});
  EXPECT_TRUE(is_alone_in_question(alone, alone[1]));
  EXPECT_FALSE(is_alone_in_question(alone, alone[0]));
  EXPECT_FALSE(is_alone_in_question(alone, alone[2]));

  std::vector<Rival> two{shortly_fitted(law, 1130, 2561), shortly_fitted(unequal, 1029, 2561),
                         shortly_fitted(arc, 1569, 2561)};
  // Which of them has its turn first their signatures say.
  EXPECT_EQ(in_question(two), (std::vector<Rival*>{&two[0], &two[1]}));
  two[1].log_odds = 46;
  EXPECT_EQ(in_question(two), (std::vector<Rival*>{&two[1], &two[0]}));
  EXPECT_FALSE(is_alone_in_question(two, two[1]));
  two[1].attempted = true;
  EXPECT_EQ(in_question(two), std::vector<Rival*>{&two[0]});
}

// Whatever makes the data more likely: of a model that they accept, and of attraction that leaves little in
// the metric of the model without.
TEST(Rival, ShortFitsThatTheDataAcceptHaveTheirTurnBeforeThoseThatLeaveLess) {
  const Candidate law = named("law"), attraction = named("attraction"), other = named("other");
  std::vector<Rival> rivals{shortly_fitted(attraction, 604, 2358), shortly_fitted(law, 1021, 2358),
                            shortly_fitted(other, 1234, 2358)};
  EXPECT_EQ(in_question(rivals), std::vector<Rival*>{&rivals[0]});
  rivals[1].short_holds = true;
  EXPECT_EQ(in_question(rivals), std::vector<Rival*>{&rivals[1]});
  EXPECT_FALSE(is_alone_in_question(rivals, rivals[0]));
  EXPECT_TRUE(is_alone_in_question(rivals, rivals[1]));
  rivals[2].short_holds = true;
  EXPECT_EQ(in_question(rivals), (std::vector<Rival*>{&rivals[1], &rivals[2]}));
  EXPECT_FALSE(is_alone_in_question(rivals, rivals[1]));
  rivals[2].short_holds = false;

  // No time for its turn: the others are in question again, however likely it seemed.
  rivals[1].short_deviance = 300;
  rivals[1].attempted = true;
  EXPECT_EQ(in_question(rivals), std::vector<Rival*>{&rivals[0]});
  EXPECT_TRUE(is_alone_in_question(rivals, rivals[0]));
  // Its turn: the data accept it, or reject it.
  rivals[1].fitted = true;
  rivals[1].state.fit.p_value = 0.5;
  EXPECT_TRUE(in_question(rivals).empty());
  rivals[1].state.fit.p_value = 0.001;
  EXPECT_EQ(in_question(rivals), std::vector<Rival*>{&rivals[0]});
}

TEST(Rival, WithoutShortFitsNoneIsInQuestion) {
  const Candidate one = named("one");
  std::vector<Rival> rivals{{&one, {}}};
  EXPECT_TRUE(in_question(rivals).empty());
  EXPECT_FALSE(is_alone_in_question(rivals, rivals[0]));
}

// The model without it leaves hardly more.
TEST(Rival, AShortFitThatGainsNothingIsNotSure) {
  const Candidate one = named("one");
  const std::vector<Rival> rivals{shortly_fitted(one, 900, 1000)};
  EXPECT_FALSE(is_alone_in_question(rivals, rivals[0]));
}

// A film of 106 mN of attraction: what the model without left of 3391 features' chi2, and what 64 simulations
// with it left. No time was left for the fit that weighs it, and its signature at 20 mN said e^-293.
TEST(Rival, AShortFitStandsWhereThereWasNoTimeForMore) {
  const Candidate one = named("grain_cohesion");
  const Candidate other = named("grain_friction");
  std::vector<Rival> rivals{shortly_fitted(one, 693, 3391), shortly_fitted(other, 1500, 3391)};
  Rival& rival = rivals[0];
  rival.screened.weighed = true;
  rival.screened.log_evidence = -293;
  rival.screened.seen.value = 1, rival.screened.seen.error = 0.1;
  EXPECT_FALSE(take_short_fit(rivals, rival));
  weigh_rival(rival, known);
  EXPECT_LT(rival.log_odds, -293);
  rival.shortly.emplace();
  rival.shortly->fit.judged_chi2 = 693;
  rivals[1].short_deviance = 720;  // not told apart by short fits
  EXPECT_FALSE(take_short_fit(rivals, rival));
  rivals[1].short_deviance = 1500;
  EXPECT_TRUE(take_short_fit(rivals, rival));
  weigh_rival(rival, known);
  StrengthSeen seen = rival.screened.seen;
  seen.gain = 3391 - 693;
  EXPECT_DOUBLE_EQ(rival.log_odds, log_odds_of(seen, known));
  EXPECT_TRUE(is_found(rival));
  EXPECT_TRUE(ranked_as(rival).fitted);
  EXPECT_EQ(ranked_as(rival).gain, seen.gain);
  rival.held_out_gain = 9;  // of a difference of two chi2
  EXPECT_EQ(ranked_as(rival).standard_error, 6);
}

// 64 simulations of attraction took a tenth of the time: 288 would take .45, 120 take .19.
TEST(Rival, AFitTakesWhatItsShortFitSaysThatTheTimeAllows) {
  const Candidate one = named("grain_cohesion");
  Rival rival = shortly_fitted(one, 693, 3391);
  EXPECT_EQ(affordable(rival, effort::attempt, 0.01).count, effort::attempt.count);  // nothing says
  rival.short_share = 0.1;
  EXPECT_EQ(simulations_of(effort::attempt), 288);
  EXPECT_EQ(simulations_of(effort::attempt_when_dear), 120);
  EXPECT_EQ(affordable(rival, effort::attempt, 0.46).count, effort::attempt.count);
  EXPECT_EQ(affordable(rival, effort::attempt, 0.44).count, effort::attempt_when_dear.count);
}

// An error of the camera is arithmetic on the recording: its signature is exact and its fit is not weighed.
TEST(Rival, AFittedErrorOfTheCameraKeepsTheOddsOfItsSignature) {
  const Candidate first = named("a");
  Candidate camera = named("camera_lens");
  camera.knobs.front().exact = true;
  std::vector<Rival> rivals{fitted(first, 1, 2600, {3, 1}), fitted(camera, 1, 2400, {30, 40})};
  rivals[1].log_ratio = std::nan("");
  weigh_beside_the_best(rivals, known);
  EXPECT_DOUBLE_EQ(rivals[1].log_odds, 2400);
}

// What a short fit alone has put somewhere is weighed by what it leaves.
TEST(Rival, AShortFitThatStandsIsWeighedByWhatItLeaves) {
  const Candidate first = named("a"), second = named("b");
  std::vector<Rival> rivals{fitted(first, 1, 2600, {3, 1}), fitted(second, 1, 2400, {1, 0})};
  rivals[1].log_ratio = std::nan("");
  rivals[1].weighed_by_left = true;
  weigh_beside_the_best(rivals, known);
  WITHIN(rivals[1].log_odds - rivals[0].log_odds, averaged(9), 1e-12, 5e-14);
}

// Its signature promised more than the fit of the best has; its own fit, which there was no time to weigh by
// more, is rejected.
TEST(Rival, AFitWithoutItsLikelihoodIsNoMoreProbableThanByWhatItLeaves) {
  const Candidate first = named("a"), second = named("b");
  std::vector<Rival> rivals{fitted(first, 1, 2557, {1, 1}), fitted(second, 1, 2608, {30, 40}, 0.001)};
  rivals[1].log_ratio = std::nan("");
  weigh_beside_the_best(rivals, known);
  WITHIN(rivals[1].log_odds - rivals[0].log_odds, -averaged(2498), 2e-12, 1.2e-13);
}

TEST(Rival, IsFoundWhereAFitMakesItMoreProbableThanNothing) {
  const Candidate one = named("a");
  EXPECT_TRUE(is_found(fitted(one, 1, 0.5, {1, 1})));
  EXPECT_FALSE(is_found(fitted(one, 1, -0.5, {1, 1})));
  EXPECT_FALSE(is_found({&one, {}}));
}

TEST(Rival, IsAsProbableAsAllItsFormsTogetherBesideNothingAndTheOthers) {
  const Candidate one = named("a"), other = named("b");
  const std::vector<Rival> rivals{fitted(one, 1, std::log(2), {1, 1}), fitted(one, 1, std::log(4), {1, 1}),
                                  fitted(other, 1, 0, {1, 1})};
  EXPECT_DOUBLE_EQ(probability_among(rivals, rivals[0]), 6.0 / 8);
  EXPECT_DOUBLE_EQ(probability_among(rivals, rivals[2]), 1.0 / 8);
}

TEST(Rival, WhatTheDataRejectKeepsItsOdds) {
  const Candidate first = named("a"), second = named("b");
  std::vector<Rival> rivals{fitted(first, 1, 2600, {1, 1}), fitted(second, 1, 2400, {0, 0}, 0.001)};
  weigh_beside_the_best(rivals, known);
  EXPECT_DOUBLE_EQ(rivals[1].log_odds, 2400);
}

// In the metric of a model that is far off it seemed better than what the data accept.
TEST(Rival, WhatTheDataRejectIsNoMoreProbableThanByWhatItLeaves) {
  const Candidate first = named("a"), second = named("b");
  std::vector<Rival> rivals{fitted(first, 1, 2400, {1, 1}), fitted(second, 1, 2600, {30, 40}, 0.001)};
  weigh_beside_the_best(rivals, known);
  WITHIN(rivals[1].log_odds - rivals[0].log_odds, -averaged(2498), 2e-12, 1.2e-13);
}

// Signatures far from any line from the model's parameters: -8212 of a pull along y, which left 6 times its
// misfit when fitted shortly, -18857 of the law that holds.
TEST(Rival, WhatWasFittedShortlyIsWeighedByWhatThatLeft) {
  const Candidate law = named("law"), pull = named("pull");
  std::vector<Rival> rivals{fitted(law, 1, 900, {1, 1}), {&pull, {}}};
  rivals[0].screened.weighed = rivals[1].screened.weighed = true;
  rivals[0].screened.log_evidence = -18857, rivals[1].screened.log_evidence = -8212;
  rivals[1].screened.seen.odds = 1;
  std::vector<Rival> without_short_fit = rivals;
  rivals[1].short_left = {Eigen::Vector2d(30, 40)};
  weigh_beside_the_best(rivals, known);
  const double error = std::hypot(effort::short_fits_differ * 2500 / 2, rules::emulator_noise / 2);
  WITHIN(rivals[1].log_odds - rivals[0].log_odds,
         -2498.0 / 2 / std::sqrt(1 + std::numbers::pi / 8 * error * error), 1e-13, 5.4e-15);
  // Without one their signatures say less than they err by; both count from where the screen is.
  for (Rival& rival : without_short_fit) rival.nothing_gained = 500;
  weigh_beside_the_best(without_short_fit, known);
  WITHIN(without_short_fit[1].log_odds - without_short_fit[0].log_odds,
         10645 / std::sqrt(1 + std::numbers::pi / 8 * 19757. * 19757.), 5e-13, 3.7e-14);
}

// A short fit of the law stands, for there was no time for more; an arc's signature is better and its short
// fit was not: the film of 2698 of chi2 by a law, 3885 by the signature of an arc.
TEST(Rival, AShortFitThatStandsIsWhatTheOthersAreWeighedBeside) {
  const Candidate law = named("law"), arc = named("arc");
  std::vector<Rival> rivals{fitted(law, 1, 1345, {1, 1}), {&arc, {}}};
  rivals[0].log_ratio = std::nan("");
  rivals[0].weighed_by_left = true;
  rivals[0].chi2_without = 3391, rivals[0].state.fit.judged_chi2 = 693;
  rivals[1].screened.weighed = true;
  rivals[1].screened.log_evidence = rivals[1].log_odds = 1940;
  rivals[1].short_left = {Eigen::Vector2d(30, 40)};
  weigh_beside_the_best(rivals, known);
  EXPECT_LT(rivals[1].log_odds, rivals[0].log_odds - 8);
}

// An error of the camera: what it gains over the model without is exact, whatever the best one's signature
// was wrong by.
TEST(Rival, AnErrorOfTheCameraThatWasNotFittedKeepsItsOdds) {
  const Candidate law = named("law");
  Candidate camera = named("camera_scale");
  camera.knobs.front().exact = true;
  std::vector<Rival> rivals{fitted(law, 1, 900, {1, 1}), {&camera, {}}};
  rivals[0].screened.weighed = rivals[1].screened.weighed = true;
  rivals[0].screened.log_evidence = -18857, rivals[1].screened.log_evidence = 50;
  rivals[1].log_odds = 46;
  weigh_beside_the_best(rivals, known);
  EXPECT_EQ(rivals[1].log_odds, 46);
}

TEST(Rival, PromisesWhatItsSignatureSaysAndAllowsForTheEngines) {
  Candidate candidate = named("grain_cohesion");
  candidate.knobs.front() = Knob{"grain_cohesion.force", 0, 0.024, 0, 0.5, true};
  candidate.knobs.front().absent = 0;
  candidate.fixed = {{"grain_cohesion.range", 0.2e-3}};
  Rival rival{&candidate, {}};
  rival.screened.value = 0.1;
  rival.screened.seen.error = 0.003;
  DiagnoseOptions options;
  options.known = all_effects();
  PromisedEffect promised = promised_by(rival, options);
  EXPECT_EQ(promised.besides, candidate.fixed);
  ASSERT_EQ(promised.strengths.size(), 1u);
  EXPECT_EQ(promised.strengths[0].unit, "N");
  EXPECT_EQ(promised.strengths[0].value, 0.1);
  EXPECT_DOUBLE_EQ(promised.strengths[0].low, 0.1 - normal_95 * 0.003);
  EXPECT_DOUBLE_EQ(promised.strengths[0].high, 0.1 + normal_95 * 0.003);
  options.strength_uncertainty = [](std::string_view) { return 0.04; };
  promised = promised_by(rival, options);
  EXPECT_DOUBLE_EQ(promised.strengths[0].low, 0.1 - normal_95 * 0.005);
  EXPECT_DOUBLE_EQ(promised.strengths[0].high, 0.1 + normal_95 * 0.005);
}
