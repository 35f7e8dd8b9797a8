// SPDX-License-Identifier: MIT
// Probabilities and intervals of answers written by hand, held against the truth.
#include "calibration.hpp"
#include "distributions.hpp"
#include "within.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace shakedown;

namespace {

OpenedCase answered(std::vector<WeighedAnswer> hypotheses,
                    std::vector<std::string> hidden = {"grain_friction"}) {
  OpenedCase one;
  one.kind = BlindKind::single;
  one.hidden = std::move(hidden);
  one.hypotheses = std::move(hypotheses);
  return one;
}

std::vector<BlindFigure> rows(void (*count)(const std::vector<OpenedCase>&, ScoreTable&),
                              const std::vector<OpenedCase>& cases) {
  ScoreTable table;
  count(cases, table);
  return table.rows;
}

}  // namespace

TEST(Calibration, TheLogScoreIsOfTheProbabilityOfTheTruth) {
  const OpenedCase sure = answered({{{"grain_friction"}, 0.8}, {{}, 0.2}}), wrong = answered({{{}, 1}});
  EXPECT_DOUBLE_EQ(log_score(sure), -std::log(0.8));
  EXPECT_DOUBLE_EQ(log_score(wrong), std::log(1000.0));
  OpenedCase lost = sure;
  lost.lost = true;
  EXPECT_DOUBLE_EQ(log_score(lost), std::log(1000.0));
  EXPECT_EQ(rows(&log_scores, {sure, lost}).front().found, "3.57 (2 cases)");  // (0.223 + 6.908) / 2
}

TEST(Calibration, AnAnswerOfAProgramWithoutProbabilitiesHasNoLogScore) {
  EXPECT_EQ(rows(&log_scores, {answered({})}).front().found, "no such case");
  EXPECT_TRUE(rows(&reliability, {answered({})}).empty());
}

TEST(Calibration, WhatIsSaidWithNineTenthsIsRightNineTimesInTen) {
  std::vector<OpenedCase> cases;
  for (int i = 0; i < 20; ++i)
    cases.push_back(answered({{{"grain_friction"}, 0.9}, {{}, 0.1}},
                             {i % 10 == 0 ? "grain_cohesion" : "grain_friction"}));
  ASSERT_EQ(rows(&reliability, cases).size(), 1u);
  EXPECT_EQ(rows(&reliability, cases)[0].verdict, BlindFigure::Verdict::met);
  EXPECT_EQ(rows(&reliability, cases)[0].found.substr(0, 8), "18 of 20");
  for (OpenedCase& one : cases) one.hidden = {"grain_cohesion"};
  EXPECT_EQ(rows(&reliability, cases)[0].verdict, BlindFigure::Verdict::missed);
}

TEST(Calibration, AnIntervalStandsForItsQuantiles) {
  WITHIN(deviations_from_middle({0, 2}, 2), normal_95, 8e-15, 4.4e-16);
  WITHIN(deviations_from_middle({0, 2}, 0.5), normal_95 / 2, 4e-15, 2.2e-16);
  EXPECT_EQ(deviations_from_middle({1, 1}, 1), 0);
  EXPECT_TRUE(std::isinf(deviations_from_middle({1, 1}, 2)));
}

TEST(Calibration, CoverageCountsTruthsWithinEachQuantile) {
  std::vector<OpenedCase> cases;
  for (int i = 0; i < 100;
       ++i) {  // one half-width is normal_95 standard deviations; truths at the normal's quantiles
    OpenedCase one = answered({});
    one.judgement.named = true;
    one.found["grain_friction.grain_wall"] = {-normal_95, normal_95};
    const double share = (i + 0.5) / 100;
    one.strengths["grain_friction.grain_wall"] = share < 0.5    ? 0.3
                                                 : share < 0.8  ? 1.0
                                                 : share < 0.95 ? 1.5
                                                                : 2.2;
    cases.push_back(one);
  }
  const std::vector<BlindFigure> found = rows(&coverage_by_quantile, cases);
  ASSERT_EQ(found.size(), 4u);
  for (const BlindFigure& row : found)
    EXPECT_EQ(row.verdict, BlindFigure::Verdict::met) << row.what << row.found;
  EXPECT_EQ(found[1].found.substr(0, 9), "80 of 100");
}

TEST(Calibration, ATieOfThreeIsRightWhereTheTruthIsAmongThem) {
  OpenedCase one = answered({});
  one.answers = {{}, {"grain_cohesion"}, {"grain_friction"}};
  EXPECT_TRUE(one.right_or_tied());
  one.answers.push_back({"spring_cubic"});
  EXPECT_FALSE(one.right_or_tied());
}

TEST(Calibration, APhaseIsTheSameAfterAWholeTurn) {
  const std::string key = "oscillating_acceleration.phase";
  WITHIN(truth_beside(key, 0.1, {6.2, 6.6}), 0.1 + 2 * M_PI, 3e-14, 1.5e-15);
  EXPECT_EQ(truth_beside("grain_friction.grain_wall", 0.1, {6.2, 6.6}), 0.1);
}
