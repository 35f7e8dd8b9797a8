// SPDX-License-Identifier: MIT
// What a diagnosis says, from what it found: all combinations.
#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "conclusion.hpp"
#include "effects.hpp"
#include "rules.hpp"
#include "setup_file.hpp"
#include "verdict.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// Rows of the table in the README of harness/diagnose. Columns: a force in no list, effects found,
/// parameters moved, the camera stands out, the features' p is small, they scatter by more than two codes
/// differ, the balance is out of order; '.': either way.
struct Row {
  std::string_view found;
  Verdict verdict;
};
constexpr Row rows[]{
    {"1......", Verdict::unknown},      // whatever else there is
    {"01.....", Verdict::missing},      // they take all of the misfit away
    {"00..11.", Verdict::unknown},      // the features reject the model
    {"00..0.1", Verdict::unknown},      // the balance does
    {"00..101", Verdict::unknown},      //
    {"00.10.0", Verdict::measurement},  //
    {"00.1100", Verdict::measurement},  // two codes differ by as much: no reason to reject
    {"00100.0", Verdict::refit},        //
    {"0010100", Verdict::refit},        //
    {"00000.0", Verdict::adequate},     //
    {"0000100", Verdict::adequate},     //
};

TEST(Verdict, OfEveryCombinationStandsInOneRow) {
  for (unsigned flags = 0; flags < 128; ++flags) {
    const auto is = [&](unsigned bit) { return (flags >> bit & 1) != 0; };
    Findings f;
    f.unlisted = is(0), f.anything_missing = is(1), f.refitted = is(2), f.camera_stands_out = is(3);
    f.features = {is(4) ? 0.001 : 0.4, is(5) ? 3.0 : 1.0, ""};
    f.balance.p_value = is(6) ? 1e-5 : 0.4;
    int matching = 0;
    for (const Row& row : rows) {
      bool matches = true;
      for (unsigned bit = 0; bit < 7; ++bit)
        matches = matches && (row.found[bit] == '.' || (row.found[bit] == '1') == is(bit));
      if (!matches) continue;
      ++matching;
      EXPECT_EQ(verdict_of(f), row.verdict) << row.found;
    }
    EXPECT_EQ(matching, 1) << "combination " << flags;
  }
}

TEST(Verdict, WhatTakesNearlyAllAwayIsNamedThoughTheModelDoesNotHold) {
  Findings f;
  f.anything_missing = true;
  f.left = {{"box", 10e-3, 1e-3}};
  f.explained = 0.95;
  EXPECT_EQ(verdict_of(f), Verdict::missing);
  f.explained = 0.5;
  EXPECT_EQ(verdict_of(f), Verdict::unknown);
  f.left.front().error = 2e-3;
  EXPECT_EQ(verdict_of(f), Verdict::missing);
  f.anything_missing = false;
  EXPECT_EQ(verdict_of(f), Verdict::adequate);
  f.left.front().error = 10e-3;
  EXPECT_EQ(verdict_of(f), Verdict::unknown);
}

/// A film of 106 mN: simulations at three levels say attraction, and the time ran out over its fit.
Diagnosis with_a_promise() {
  Diagnosis d;
  d.verdict = Verdict::unknown;
  d.amended.restitution.grain_grain = 0.35;  // where the fit without attraction has led it
  d.parameters = {{"restitution.grain_grain", 0.35, 0.3, 0.4, "", ""},
                  {"spring.frequency", 1.23, 1.22, 1.24, "Hz", ""}};
  d.promised = PromisedEffect{"grain_cohesion",
                              {{"grain_cohesion.range", 0.2e-3}},
                              {{"grain_cohesion.force", 0.106, 0.05, 0.16, "N", ""}}};
  d.hypotheses = {{{"spring_cubic", "grain_cohesion"}, 0, 0.94}, {{"unknown"}, 0, 0.06}};
  return d;
}

TEST(Verdict, FollowsTheTableWhereTheMostProbableWasNotFitted) {
  const shakedown::Setup user = parse_setup("", "given", all_effects());
  Diagnosis d = with_a_promise();
  name_promised(user, {"spring_cubic"}, d, all_effects());
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.missing, (std::vector<std::string>{"spring_cubic", "grain_cohesion"}));
  EXPECT_EQ(get_number(d.amended, "grain_cohesion.force", all_effects()), 0.106);
  EXPECT_EQ(get_number(d.amended, "grain_cohesion.range", all_effects()), 0.2e-3);
  // The restitutions were fitted without it.
  EXPECT_EQ(d.amended.restitution.grain_grain, user.restitution.grain_grain);
  ASSERT_EQ(d.parameters.size(), 2u);
  EXPECT_EQ(d.parameters[0].name, "spring.frequency");
  EXPECT_EQ(d.parameters[1].name, "grain_cohesion.force");
}

TEST(Verdict, StaysWhereThePromisedIsDoubtfulOrTheBalanceIsOpen) {
  const auto stays = [](const Diagnosis& given) {
    Diagnosis d = given;
    name_promised(parse_setup("", "given", all_effects()), {"spring_cubic"}, d, all_effects());
    return d.verdict == given.verdict && d.missing == given.missing && !d.promised &&
           d.parameters.size() == given.parameters.size();
  };
  Diagnosis d = with_a_promise();
  d.hypotheses[0].probability = 0.89;
  EXPECT_TRUE(stays(d));
  d = with_a_promise();
  d.hypotheses[0].effects = {"grain_friction"};
  EXPECT_TRUE(stays(d));
  d = with_a_promise();
  d.momentum.unexplained = true;  // a force on the box that nothing inside the contacts is
  EXPECT_TRUE(stays(d));
  // An earlier round's effect was taken back since: the table still has it.
  d = with_a_promise();
  d.hypotheses[0].effects = {"grain_friction", "spring_cubic", "grain_cohesion"};
  EXPECT_TRUE(stays(d));
  // Another component of an effect that was fitted.
  d = with_a_promise();
  d.verdict = Verdict::missing;
  d.missing = {"grain_cohesion"};
  EXPECT_TRUE(stays(d));
  d = with_a_promise();
  d.promised.reset();
  EXPECT_TRUE(stays(d));
  d = with_a_promise();
  d.verdict = Verdict::refit;
  EXPECT_TRUE(stays(d));
}

TEST(Verdict, AnErrorIsComparedWithThatOfTheModelAsGivenWhereBothAreKnown) {
  Validation given, fitted;
  given.observable = fitted.observable = "box";
  given.error = 3e-3, fitted.error = 1e-3;
  Difference box{"box", 2e-3, 1e-3};
  compare_with_given({given}, {}, box);
  compare_with_given({}, {fitted}, box);
  EXPECT_EQ(box.error, 2e-3);
  compare_with_given({given}, {fitted}, box);
  EXPECT_EQ(box.as_given, 3e-3);
  EXPECT_EQ(box.error, 1e-3);
}

TEST(Verdict, WhatIsLeftWeighsSomethingInNoList) {
  EXPECT_EQ(p_value_of_left({}), 1);
  EXPECT_EQ(p_value_of_left({{"box", 2.4e-3, 1e-3}}), 1);  // within what right answers leave
  EXPECT_LT(p_value_of_left({{"box", 2.6e-3, 1e-3}}), 1e-6);
  Findings f;
  f.left = {{"box", 3e-3, 1e-3}};
  EXPECT_LT(worst_p_value(f), 1e-6);
}

TEST(Verdict, AtTheEdges) {
  EXPECT_EQ(verdict_of({}), Verdict::adequate);
  Findings f;
  f.features.misfit = 2;
  f.features.p_value = rules::holds;  // at the bound it is rejected
  EXPECT_EQ(verdict_of(f), Verdict::unknown);
  f.features.p_value = rules::holds * 1.01;
  EXPECT_EQ(verdict_of(f), Verdict::adequate);
  f.features.p_value = 0;  // two codes differ by as much
  f.features.misfit = rules::codes_differ * 0.99;
  EXPECT_EQ(verdict_of(f), Verdict::adequate);
}

TEST(Verdict, WhatIsNoNumberIsNotInOrder) {
  Findings f;
  f.balance.p_value = std::nan("");
  EXPECT_EQ(verdict_of(f), Verdict::unknown);
  f = {};
  f.features.p_value = std::nan("");
  f.features.misfit = 3;
  EXPECT_EQ(verdict_of(f), Verdict::unknown);
  f.features.misfit = std::nan("");
  EXPECT_EQ(verdict_of(f), Verdict::unknown);
}

TEST(Verdict, AnExplanationLeavesLittleOfTheMisfit) {
  const double floor = 1e-4;
  EXPECT_TRUE(explains(0.2, 50, 50, 1, floor));     // accepted: whatever is left
  EXPECT_TRUE(explains(1e-4, 2.5, 2.6, 1, floor));  // as two codes differ
  EXPECT_TRUE(explains(1e-4, 10, 50, 3.9 * floor, floor));
  EXPECT_FALSE(explains(1e-4, 10, 50, 4.1 * floor, floor));  // far above noise and chaos
  EXPECT_FALSE(explains(1e-4, 31, 50, 2 * floor, floor));    // most of the misfit stays
  EXPECT_FALSE(explains(1e-4, std::nan(""), 50, 2 * floor, floor));
  EXPECT_FALSE(explains(1e-4, 10, 50, std::nan(""), floor));
}

TEST(Verdict, WhatStandsOutIsSortedByCertainty) {
  const double bound = rules::stands_out;
  const std::vector<NuisanceFound> found = standing_out({{"lens", "", 1, 0.9 * bound, 1},
                                                         {"shutter", "s", 1, -1.1 * bound, 1},
                                                         {"origin", "m", 1, 3 * bound, 2},
                                                         {"scale", "", 1, 5, 0},
                                                         {"trigger", "s", 1, std::nan(""), 1},
                                                         {"depth", "", 1, 5, std::nan("")}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "origin");
  EXPECT_EQ(found[1].name, "shutter");
  EXPECT_TRUE(standing_out({}).empty());
}

TEST(Verdict, ALateTriggerIsNoErrorThatRose) {
  // Two late runs: the box is 2 mm off before and 2.4 mm after a fit, most of it the trigger's own doing.
  const std::vector<Validation> given{{"a", "box", 9e-4, 3e-4, 0, 1e-4},
                                      {"a", "centre", 1e-3, 1e-3, 0, 0},
                                      {"b", "box", 7e-4, 3e-4, 0, 1e-4}},
      fitted{{"a", "box", 3e-4, 3e-4, 0, 1e-4}, {"b", "box", 4e-4, 3e-4, 0, 1e-4}};
  Difference box{"box", 2.4e-3, 8e-4, 2e-3};
  ASSERT_NE(judgement_of({0.5, 1, ""}, {0.5, 1, ""}, {box}).standing, Standing::holds);
  compare_with_given(given, fitted, box);
  EXPECT_DOUBLE_EQ(box.as_given, 1e-4 * std::sqrt((81 + 49) / 2.0));
  EXPECT_DOUBLE_EQ(box.error, 1e-4 * std::sqrt((9 + 16) / 2.0));
  EXPECT_EQ(judgement_of({0.5, 1, ""}, {0.5, 1, ""}, {box}).standing, Standing::holds);
  Difference alone = box;
  compare_with_given({}, fitted, alone);
  EXPECT_EQ(alone.error, box.error);
  // It still speaks where a fit made things worse.
  compare_with_given(fitted, {{"a", "box", 3e-3, 3e-4, 0, 1e-4}}, box);
  EXPECT_NE(judgement_of({0.5, 1, ""}, {0.5, 1, ""}, {box}).standing, Standing::holds);
}

// A model that fails speaks for each effect that there was no time to look at as it does for something in no
// list.
TEST(Verdict, WhereNoRoundWasHeldAFailingModelSpeaksForWhatNobodyLookedAt) {
  Diagnosis d;
  d.hypotheses = {{{}, 0, 0.8}, {{"grain_friction"}, 0, 0.15}, {{"grain_air_drag"}, 0, 0.05}};
  d.not_tried = {no_round_held};
  Findings findings;
  findings.features = {1 / 401.0, 11, ""};
  findings.far_p_value = 1e-100;
  settle_hypotheses(d, findings);
  ASSERT_EQ(d.hypotheses.size(), 3u);
  EXPECT_EQ(d.hypotheses[0].effects, std::vector<std::string>{"grain_friction"});
  EXPECT_EQ(d.hypotheses[2].effects, std::vector<std::string>{std::string(unlisted_effect)});
  // All three have their priors, for nothing explains the data as they are.
  WITHIN(d.hypotheses[0].probability / d.hypotheses[1].probability, 3, 1.5e-14, 8.9e-16);
  WITHIN(d.hypotheses[0].probability / d.hypotheses[2].probability,
         0.15 * (1 - rules::something_else) / rules::something_else, 1.5e-14, 8.9e-16);
}

// A shape that there was no time for is named as not tried; the effect was fitted in another one.
TEST(Verdict, WhatWasFittedInOneOfItsShapesWasLookedAt) {
  Diagnosis d;
  d.hypotheses = {{{"grain_cohesion"}, 0, 0.99}, {{}, 0, 0.01}};
  d.ranking = {{.effect = "grain_cohesion", .fitted = true}};
  d.not_tried = {"grain_cohesion"};
  Findings findings;
  findings.features = {1 / 401.0, 3, ""};
  findings.far_p_value = 1e-6;
  Diagnosis other = d;
  other.not_tried.clear();
  settle_hypotheses(d, findings);
  settle_hypotheses(other, findings);
  EXPECT_EQ(d.hypotheses.front().effects, std::vector<std::string>{std::string(unlisted_effect)});
  EXPECT_EQ(d.hypotheses.front().probability, other.hypotheses.front().probability);
}

TEST(Verdict, WhatTheBalanceWeighedWasLookedAt) {
  Diagnosis d;
  d.hypotheses = {{{}, 0, 0.6}, {{"spring_cubic"}, 0, 0.3}, {{"grain_friction"}, 0, 0.1}};
  d.momentum.seen = {"spring_cubic.coefficient"};
  d.not_tried = {no_round_held};
  Findings findings;
  findings.features = {1 / 401.0, 11, ""};
  findings.far_p_value = 1e-100;
  settle_hypotheses(d, findings);
  EXPECT_EQ(d.hypotheses.front().effects, std::vector<std::string>{"grain_friction"});
  for (const Hypothesis& h : d.hypotheses)
    EXPECT_NE(h.effects, std::vector<std::string>{"spring_cubic"}) << h.probability;
}

// What a round has looked at and found improbable stays so where there is no time for another one beside what
// was added.
TEST(Verdict, WhatOneRoundLookedAtIsOpenBesideWhatItAddedAlone) {
  Diagnosis d;
  d.hypotheses = {{{"grain_cohesion"}, 0, 0.8},
                  {{"grain_cohesion", "grain_friction"}, 0, 0.2},
                  {{"grain_friction"}, 0, 1e-20}};
  d.ranking = {{.effect = "grain_cohesion", .fitted = true}, {.effect = "grain_friction"}};
  d.not_tried = {no_round_held};
  Findings findings;
  findings.found = {"grain_cohesion"};
  findings.features = {1 / 401.0, 11, ""};
  findings.far_p_value = 1e-100;
  settle_hypotheses(d, findings);
  EXPECT_EQ(d.hypotheses.front().effects, (std::vector<std::string>{"grain_cohesion", "grain_friction"}));
  for (const Hypothesis& h : d.hypotheses)
    EXPECT_NE(h.effects, std::vector<std::string>{"grain_friction"}) << h.probability;
}

}  // namespace

// Weak friction was added beside an acceleration that the data accepted (p = .03), and both errors rose.
TEST(Verdict, WhatMakesNoErrorFallIsNoExplanation) {
  const std::vector<Validation> before{{"a", "box", 8e-4, 0, 0, 0}, {"a", "centre", 1.1e-3, 0, 0, 0}};
  std::vector<Validation> after = before;
  EXPECT_FALSE(no_error_falls(before, after));
  after[0].error = 9e-4;
  EXPECT_FALSE(no_error_falls(before, after));
  after[1].error = 1.5e-3;
  EXPECT_TRUE(no_error_falls(before, after));
  after.pop_back();
  EXPECT_FALSE(no_error_falls(before, after));
  EXPECT_FALSE(no_error_falls({}, {}));
}

// Felt on the end walls, in a list of effects: time ran out after a law of restitution, which the data
// rejected too.
TEST(Verdict, WhatIsAddedBetweenRejectedModelsMustLetAnErrorFall) {
  const std::vector<Validation> before{{"a", "box", 6.06e-4, 0, 0, 0}, {"a", "centre", 1.407e-3, 0, 0, 0}};
  std::vector<Validation> after{{"a", "box", 9.09e-4, 0, 0, 0}, {"a", "centre", 1.789e-3, 0, 0, 0}};
  EXPECT_TRUE(adds_nothing(0.0025, before, after));
  EXPECT_FALSE(adds_nothing(0.2, before, after));
  after[1].error = 1.2e-3;
  EXPECT_FALSE(adds_nothing(0.0025, before, after));
}

// 17.4 as given and 2.7 with what was found: less than nine tenths.
TEST(Verdict, WhatFailsAndExplainsTooLittleIsNoExplanation) {
  WITHIN(share_taken_away(17.4, 2.7), 14.7 / 16.4, 4e-15, 2e-16);
  EXPECT_EQ(share_taken_away(0.9, 0.8), 1);
  Findings findings;
  findings.anything_missing = true;
  findings.features = {.p_value = 0.0025, .misfit = 2.7};
  findings.explained = share_taken_away(17.4, 2.7);
  EXPECT_EQ(verdict_of(findings), Verdict::unknown);
  findings.explained = share_taken_away(17.4, 1.6);
  EXPECT_EQ(verdict_of(findings), Verdict::missing);
}
