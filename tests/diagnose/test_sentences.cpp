// SPDX-License-Identifier: MIT
// What a diagnosis says in words never contradicts its numbers.
#include <gtest/gtest.h>

#include "effects.hpp"
#include "sentences.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

Diagnosis found(std::vector<std::string> missing) {
  Diagnosis d;
  d.verdict = Verdict::missing;
  d.missing = std::move(missing);
  d.judgement.standing = Standing::holds;
  d.explained = 0.97;
  d.ladder = {{"as given", 10e-3}, {"refitted", 1e-3}};
  d.answers = {{d.missing, 0, 0.99}};
  return d;
}

bool says(const Diagnosis& d, std::string_view words) {
  return sentence_of(d, all_effects()).find(words) != std::string::npos;
}

TEST(Sentence, AnErrorRisesWhereItRises) {
  Diagnosis d = found({"blade_quadratic_drag"});
  EXPECT_TRUE(says(d, "falls from 10.00 mm (as given) to 1.00 mm")) << sentence_of(d, all_effects());
  std::swap(d.ladder[0], d.ladder[1]);
  EXPECT_TRUE(says(d, "rises from 1.00 mm")) << sentence_of(d, all_effects());
}

TEST(Sentence, InsteadOnlyWhereAHypothesisSaysSo) {
  Diagnosis d = found({"blade_quadratic_drag"});
  d.answers = {{{"blade_quadratic_drag"}, 0, 0.7}, {{"blade_quadratic_drag", "spring_cubic"}, 0, 0.28}};
  EXPECT_TRUE(says(d, "do not rule out spring_cubic beside it.")) << sentence_of(d, all_effects());
  d.answers[1].effects = {"spring_cubic"};
  EXPECT_TRUE(says(d, "do not rule out spring_cubic instead of it."));
  d.answers.push_back({{"blade_quadratic_drag", "spring_cubic"}, 0, 0.02});
  EXPECT_TRUE(says(d, "beside or instead of it."));
}

TEST(Sentence, OfManyThatAreNotRuledOutTheMostProbableAreNamed) {
  Diagnosis d = found({"blade_quadratic_drag"});
  d.answers = {{{"blade_quadratic_drag"}, 0, 0.3}};
  for (const char* other : {"a", "b", "c", "d", "e"}) d.answers.push_back({{other}, 0, 0.1});
  EXPECT_TRUE(says(d, "do not rule out a, b, c, d or e instead of it.")) << sentence_of(d, all_effects());
  d.answers.push_back({{"f"}, 0, 0.1});
  EXPECT_TRUE(says(d, "do not rule out a, b, c, d or 2 less probable ones instead of it."))
      << sentence_of(d, all_effects());
}

TEST(Sentence, WhatIsMostProbableAndWasNotFittedIsNamed) {
  Diagnosis d = found({"grain_cohesion"});
  d.parameters = {{"grain_cohesion.force", 0.106, 0.05, 0.16, "N", ""}};
  d.hypotheses = {{{"grain_cohesion"}, 0, 0.942}, {{"unknown"}, 0, 0.02}};
  d.answers = {};
  EXPECT_TRUE(says(d, "Missing in the model: attraction")) << sentence_of(d, all_effects());
  d.promised = PromisedEffect{"grain_cohesion", {}, d.parameters};
  EXPECT_FALSE(says(d, "rms error")) << sentence_of(d, all_effects());
  EXPECT_TRUE(says(d,
                   "Most probably missing in the model: attraction of the grains (grain_cohesion), 106 mN "
                   "(94.2 %), by simulations at a few strengths; there was no time to fit grain_cohesion"))
      << sentence_of(d, all_effects());
}

TEST(Sentence, AModelThatDoesNotHoldIsToldAsThat) {
  Diagnosis d = found({"blade_quadratic_drag"});
  EXPECT_FALSE(says(d, "does not hold"));
  d.judgement = {Standing::fails, true, "rejected: 10 mm of the box remain"};
  EXPECT_TRUE(
      says(d, "explains 97 % of the misfit as given; with it the model still does not hold (rejected: 10 mm"))
      << sentence_of(d, all_effects());
}

TEST(Sentence, KnownEffectsBesideAForceOfNoListStayNamed) {
  Diagnosis d = found({"blade_viscous_damping"});
  d.verdict = Verdict::unknown;
  d.momentum.unlisted = true;
  EXPECT_TRUE(says(d, "acts on the box, beside linear damping")) << sentence_of(d, all_effects());
}

TEST(Sentence, OfAnEmptyBoxSaysNothingOfContacts) {
  Diagnosis d = found({});
  d.verdict = Verdict::unknown;
  d.momentum.possible = true;
  d.amended.grains.count = 0;
  d.judgement = {Standing::fails, true, "rejected: 10 mm of the box remain"};
  d.left = {{"box", 10e-3, 1e-3}};
  EXPECT_FALSE(says(d, "contacts")) << sentence_of(d, all_effects());
  EXPECT_TRUE(says(d, "10 mm of the box remain"));
}

TEST(Hypotheses, SomethingElseStandsBesideWhatWasFound) {
  const std::vector<Hypothesis> table = with_something_else({{{"a"}, 0, 1}}, 0.99, {"a"});
  EXPECT_EQ(table.front().effects, (std::vector<std::string>{"a", unlisted_effect}));
  WITHIN(table[0].probability + table[1].probability, 1, 4e-15, 2.3e-16);
}

}  // namespace

TEST(Sentence, AModelThatHoldsHasAPValueOnlyWhereOneWasMade) {
  Diagnosis d;
  d.verdict = Verdict::adequate;
  d.ladder.emplace_back();
  d.ladder.back().p_value = 0.4;
  EXPECT_TRUE(says(d, "run to run (p = 0.4).")) << sentence_of(d, all_effects());
  d.ladder.back().p_value = std::nan("");  // of a waveform
  EXPECT_TRUE(says(d, "run to run.")) << sentence_of(d, all_effects());
}
