// SPDX-License-Identifier: MIT
// The rule by which a model holds or fails, and the table of validation uncertainties.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "judgement.hpp"
#include "missing_numbers.hpp"
#include "validation.hpp"

using namespace shakedown;

namespace {

const double nan = std::nan(""), inf = INFINITY;

TEST(Judgement, OfEveryCombination) {
  const ModelTest none{nan, nan, "not asked for"}, good{0.4, 1, ""}, poor{0.002, 3, ""},
      close{0.002, 1.2, ""}, off{1e-5, nan, ""};
  EXPECT_EQ(judgement_of(good, good).standing, Standing::holds);
  EXPECT_EQ(judgement_of(good, none).standing, Standing::holds);
  EXPECT_EQ(judgement_of(none, good).standing, Standing::holds);
  EXPECT_EQ(judgement_of(poor, good).standing, Standing::fails);
  EXPECT_EQ(judgement_of(poor, none).standing, Standing::fails);
  EXPECT_EQ(judgement_of(close, good).standing, Standing::undecided);
  EXPECT_EQ(judgement_of(close, none).standing, Standing::undecided);
  EXPECT_EQ(judgement_of(good, off).standing, Standing::fails);
  EXPECT_EQ(judgement_of(close, off).standing, Standing::fails);
  EXPECT_EQ(judgement_of(none, off).standing, Standing::fails);
  EXPECT_EQ(judgement_of(none, none).standing, Standing::undecided);
}

TEST(Judgement, GivesItsReason) {
  EXPECT_EQ(judgement_of({0.3, 1, ""}, {1e-5, nan, ""}).reason, "rejected: momentum balance p = 1e-05");
  EXPECT_EQ(judgement_of({0.002, 3, ""}, {1e-5, nan, ""}).reason,
            "rejected: momentum balance p = 1e-05, features p = 0.002 (3 times the misfit of the model's own "
            "runs)");
  EXPECT_EQ(judgement_of({0.3, 1, ""}, {nan, nan, "no grains' position"}).reason, "holds: features p = 0.3");
  EXPECT_EQ(judgement_of({nan, nan, "no runs"}, {nan, nan, "no frames"}).reason,
            "undecided: nothing could be tested (no runs; no frames)");
}

TEST(Judgement, AtTheBoundsTheModelFails) {
  EXPECT_EQ(judgement_of({features_rejected, 2, ""}, {1, nan, ""}).standing, Standing::fails);
  EXPECT_EQ(judgement_of({features_rejected * 1.01, 2, ""}, {1, nan, ""}).standing, Standing::holds);
  EXPECT_EQ(judgement_of({1, 1, ""}, {balance_rejected, nan, ""}).standing, Standing::fails);
  EXPECT_EQ(judgement_of({0, codes_differ, ""}, {1, nan, ""}).standing, Standing::fails);
}

/// What is no number never lets a model hold.
TEST(Judgement, NoNumberNeverHolds) {
  for (const double bad : {nan, inf, -inf, -0.1, 1.1}) {
    EXPECT_EQ(judgement_of({bad, 1, ""}, {0.4, nan, ""}).standing, Standing::undecided) << bad;
    EXPECT_EQ(judgement_of({0.4, 1, ""}, {bad, nan, ""}).standing, Standing::undecided) << bad;
    EXPECT_FALSE(judgement_of({0.4, 1, ""}, {bad, nan, ""}).complete);
    EXPECT_EQ(judgement_of({0.4, 1, ""}, {bad, nan, ""}).reason,
              "undecided: the p-value of the momentum balance could not be computed");
  }
  EXPECT_EQ(judgement_of({1e-4, nan, ""}, {0.4, nan, ""}).standing, Standing::fails);
  EXPECT_EQ(judgement_of({nan, nan, ""}, {1e-5, nan, ""}).standing, Standing::fails);
}

const ModelTest in_order{0.9, 1, ""};

TEST(Judgement, WhatIsLeftIsAtMostSomeTimesNoiseAndSpread) {
  const auto with = [](double error) {
    return judgement_of(in_order, in_order, {{"box", error, 1e-3, nan, 0.1, "mostly a swing of 2 Hz"}});
  };
  EXPECT_EQ(with(0.99e-3 * most_left).standing, Standing::holds);
  const ModelJudgement fails = with(1.01e-3 * most_left);
  EXPECT_EQ(fails.standing, Standing::fails);
  EXPECT_EQ(fails.reason,
            "rejected: 2.5 mm (2.5 % of the amplitude), mostly a swing of 2 Hz, of the box remain, 2.5 times "
            "noise and spread");
  EXPECT_EQ(with(INFINITY).standing, Standing::fails);
  EXPECT_EQ(with(nan).standing, Standing::holds);  // not asked about
}

TEST(Judgement, AnErrorThatRoseNeverHolds) {
  const auto with = [](double given, double error) {
    return judgement_of(in_order, in_order, {{"box", error, 1e-3, given}}).standing;
  };
  EXPECT_EQ(with(0.9e-3, 1.3e-3), Standing::holds);  // by less than noise and spread
  EXPECT_EQ(with(2.2e-3, 2.4e-3), Standing::holds);
  EXPECT_EQ(with(0.9e-3, 1.4e-3), Standing::fails);
  EXPECT_EQ(with(3e-3, 1e-3), Standing::holds);
}

TEST(Judgement, AndTheTableOfValidationNeverSayDifferentThings) {
  for (const double error : {0.5e-3, 1.5e-3, 2.4e-3, 2.6e-3, 40e-3}) {
    const std::vector<Validation> rows{{"a", "box", error, 0.6e-3, 0.8e-3, 0}};
    const bool holds = judgement_of(in_order, in_order, differences_of(rows)).holds();
    EXPECT_EQ(validation_text(rows).find("about") == std::string::npos, holds) << error;
  }
}

TEST(Validation, AddsItsUncertaintiesInSquares) {
  const Validation row{"a", "box", 13e-3, 3e-3, 0, 4e-3};
  EXPECT_DOUBLE_EQ(row.uncertainty(), 5e-3);
  EXPECT_DOUBLE_EQ(row.model_error(), 12e-3);
  const Validation within{"a", "box", 2.9e-3, 2e-3, 1e-3, 2e-3};
  EXPECT_EQ(within.model_error(), 0);
  const std::string text = validation_text({row, within});
  EXPECT_NE(text.find("about 12.000"), std::string::npos) << text;
  EXPECT_NE(text.find("within u_val"), std::string::npos) << text;
  EXPECT_EQ(validation_json({row}).at(0).at("u_val_mm").get<double>(), row.uncertainty() * 1e3);
  EXPECT_EQ(validation_text({}), "");
}

TEST(Validation, SaysWhereItCouldNotBeComputed) {
  for (const double bad : {nan, inf}) {
    const Validation error{"a", "box", bad, 1e-3, 1e-3, 1e-3}, unknown{"a", "box", 1e-3, bad, 1e-3, 1e-3};
    EXPECT_NE(validation_text({error}).find("could not be computed"), std::string::npos);
    EXPECT_NE(validation_text({unknown}).find("could not be computed"), std::string::npos);
  }
}

TEST(MissingNumbers, BecomeNullWithAReason) {
  nlohmann::ordered_json document{{"a", 1.5}, {"b", {{"c", nan}, {"d", nullptr}}}, {"e", {1.0, inf}}};
  explain_missing_numbers(document, [](const std::string& path) {
    return path == "/b/c" ? std::string("no frames") : std::string();
  });
  EXPECT_TRUE(document["b"]["c"].is_null());
  EXPECT_TRUE(document["e"][1].is_null());
  EXPECT_EQ(document["not_computed"].size(), 2u) << "a null that was meant is none of them";
  EXPECT_EQ(document["not_computed"]["/b/c"], "no frames");
  EXPECT_NE(document["not_computed"]["/e/1"].get<std::string>().find("could not be computed"),
            std::string::npos);
  nlohmann::ordered_json sound{{"a", 1.5}};
  explain_missing_numbers(sound);
  EXPECT_EQ(sound.dump(), R"({"a":1.5})");
}

}  // namespace
