// SPDX-License-Identifier: MIT
// What a diagnosis looks for follows from the records, those of tomorrow included.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "candidates.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "parameter_knobs.hpp"
#include "physics.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

EffectRecord brake_of_tomorrow() {
  EffectRecord brake;
  brake.name = "cubic_brake";
  brake.parameters = {
      {.name = "drag", .unit = "N s^3/m^3", .low = 0, .high = 5, .neutral = 0, .typical = 0.2}};
  brake.engines = {{every_engine, {Fidelity::exact, ""}}};
  brake.apply = [](const EffectChoice& choice, int index, Physics& physics) {
    const double drag = choice.number("drag");
    physics.box.free.push_back({[drag](double, double v, double) { return -drag * v * v * v; }, index});
  };
  return brake;
}

const Candidate& candidate_for(const std::vector<Candidate>& list, std::string_view effect) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const Candidate& candidate) { return candidate.effect == effect; });
  EXPECT(found != list.end());
  return *found;
}

}  // namespace

TEST(Candidates, AnEffectOfTomorrowIsLookedForByItsRecordAlone) {
  const EffectRecord brake = brake_of_tomorrow();
  std::vector<const EffectRecord*> known(all_effects().begin(), all_effects().end());
  known.push_back(&brake);
  const std::vector<Candidate> list = candidates_for({}, {}, known, *engine_named("hard"));
  const Candidate& found = candidate_for(list, "cubic_brake");
  ASSERT_EQ(found.knobs.size(), 1u);
  EXPECT_EQ(found.knobs[0].key, "cubic_brake.drag");
  EXPECT_EQ(found.knobs[0].centre, 0);
  EXPECT_EQ(found.knobs[0].width, 0.2);
  EXPECT_EQ(found.knobs[0].high, 5);
  EXPECT_EQ(found.prior.typical, 0.2);
  EXPECT_EQ(found.prior.odds, 1);
  EXPECT_TRUE(found.prior.one_sided);
}

// A diagnosis by hard grains of a film of soft ones found 4 mN over 0.02 mm that nothing had: below 20 mN the
// two codes differ by as much.
TEST(Candidates, AttractionIsLookedForFromWhereCodesDoNotDiffer) {
  int short_ones = 0, long_ones = 0;
  for (const Candidate& candidate :
       candidates_for({}, {"grain_cohesion"}, all_effects(), *engine_named("hard"))) {
    const double range = candidate.fixed.at(0).second, least = range < 1e-4 ? 20e-3 : 4e-3;
    EXPECT_EQ(candidate.fixed.at(0).first, "grain_cohesion.range");
    EXPECT_EQ(candidate.knobs.at(0).low, least);
    // Half of the box lies there: a scatter of which all lies below would be none.
    EXPECT_GE(candidate.knobs.at(0).at(1), 2 * least);
    EXPECT_EQ(candidate.levels.front().value, range < 1e-4 ? 24e-3 : 4e-3);
    ++(range < 1e-4 ? short_ones : long_ones);
  }
  EXPECT_EQ(short_ones, 2);
  EXPECT_EQ(long_ones, 2);
}

TEST(Candidates, KnobsStandWhereTheEffectIsAbsent) {
  shakedown::Setup setup;
  setup.restitution.grain_wall = 0.6;
  const std::vector<Candidate> list = candidates_for(setup, {}, all_effects(), *engine_named("hard"));
  const Knob& side = candidate_for(list, "side_wall_restitution").knobs.at(0);
  EXPECT_EQ(side.centre, 0.6);
  EXPECT_EQ(side.width, 0.2);
  EXPECT_EQ(side.absent, 0.6);
  EXPECT_EQ(side.absent_key, "restitution.grain_wall");
  const Candidate& friction = candidate_for(list, "grain_friction");
  EXPECT_TRUE(friction.dear && friction.knobs.at(0).cubic);
  ASSERT_EQ(friction.levels.size(), 5u);
  EXPECT_EQ(friction.levels[2].strength, 0.2);
  EXPECT_EQ(friction.levels[2].value, 0.2);
  const Candidate& walls = candidate_for(list, "side_wall_restitution");
  WITHIN(walls.levels.at(3).value, 0.2, 1e-15, 5.6e-17);
  WITHIN(walls.levels.at(3).strength, -0.4, 1e-15, 8.9e-17);
  WITHIN(walls.strengths.low, 0.05 - 0.6, 2e-15, 1.3e-16);
  EXPECT_DOUBLE_EQ(walls.strengths.high, 2 * 0.15);  // trusted up to twice a level of that side
  EXPECT_EQ(friction.knobs.at(0).key, "grain_friction.grain_grain&grain_friction.grain_wall");
  const Candidate& arc = candidate_for(list, "blade_arc");
  EXPECT_TRUE(arc.knobs.empty());
  EXPECT_EQ(arc.fitted_knobs().at(0).centre, 0.59);
  // The curvature of a blade of this length, which cannot be negative.
  WITHIN(arc.prior.typical, 1 / (0.59 * 0.59), 1e-14, 6.4e-16);
  EXPECT_TRUE(arc.prior.one_sided);
  WITHIN(arc.levels.at(1).strength, 1 / (0.59 * 0.59), 1e-14, 6.4e-16);
  WITHIN(arc.value_of(arc.strength_of(0.4)), 0.4, 1e-15, 8.9e-17);
  EXPECT_LT(candidate_for(list, "grain_air_drag").prior.odds, 0.01);  // air does so little in fact
  EXPECT_FALSE(candidate_for(list, "spring_cubic").prior.one_sided);
}

TEST(Candidates, AShapeThatNoStrengthTellsMakesAlternatives) {
  const std::vector<Candidate> list =
      candidates_for(shakedown::Setup{}, {"grain_cohesion"}, all_effects(), *engine_named("hard"));
  std::vector<std::pair<double, double>> range_and_walls;
  double odds = 0;
  for (const Candidate& candidate : list) {
    ASSERT_EQ(candidate.fixed.size(), 2u);
    EXPECT_EQ(candidate.fixed[0].first, "grain_cohesion.range");
    EXPECT_EQ(candidate.fixed[1].first, "grain_cohesion.walls");
    range_and_walls.emplace_back(candidate.fixed[0].second, candidate.fixed[1].second);
    odds += candidate.prior.odds;
  }
  EXPECT_EQ(range_and_walls,
            (std::vector<std::pair<double, double>>{{2e-5, 0}, {2e-5, 1}, {2e-4, 0}, {2e-4, 1}}));
  EXPECT_DOUBLE_EQ(odds, 0.135);  // as likely together as one
}

// Side walls that take .6 more than the end walls are looked for though a fit without them has put these at
// .42: they lie elsewhere beside it.
TEST(Candidates, SideWallsAreLookedForAtEveryStrengthWhereverTheEndWallsWereFitted) {
  for (const double walls : {0.42, 0.76, 0.95}) {
    shakedown::Setup setup;
    set_number(setup, "restitution.grain_wall", walls, all_effects());
    const std::vector<Candidate> list = candidates_for(setup, {"side_wall_restitution"}, all_effects(),
                                                       *engine_named("hard"), free_parameters(setup));
    ASSERT_EQ(list.size(), 1u);
    // Where the end walls are known they make no room.
    const Candidate known =
        candidates_for(setup, {"side_wall_restitution"}, all_effects(), *engine_named("hard")).at(0);
    for (const Candidate::Level& level : known.levels) EXPECT_EQ(level.value - walls, level.strength);
    std::vector<double> strengths;
    for (const Candidate::Level& level : list[0].levels) {
      strengths.push_back(level.strength);
      EXPECT_GE(level.value, list[0].knobs[0].low);
      EXPECT_LE(level.value, list[0].knobs[0].high);
    }
    EXPECT_EQ(strengths, (std::vector<double>{-0.1, 0.15, -0.2, -0.4, -0.6})) << walls;
    EXPECT_LE(list[0].strengths.low, -0.61);
    EXPECT_GE(list[0].strengths.high, 0.15);
  }
}

TEST(Candidates, LeaveOutWhatTheSetupHasAndWhatItCannotHave) {
  shakedown::Setup setup;
  set_number(setup, "spring_cubic.coefficient", 0.1, all_effects());
  for (const Candidate& candidate : candidates_for(setup, {}, all_effects(), *engine_named("hard")))
    EXPECT_NE(candidate.effect, "spring_cubic");
  shakedown::Setup at_rest;
  at_rest.release.displacement = 0;  // a cubic spring would have no scale
  const std::vector<Candidate> list = candidates_for(at_rest, {}, all_effects(), *engine_named("hard"));
  EXPECT_FALSE(list.empty());
  for (const Candidate& candidate : list) EXPECT_NE(candidate.effect, "spring_cubic");
  EXPECT_EQ(candidates_for({}, {"grain_air_drag"}, all_effects(), *engine_named("hard")).size(), 1u);
}

namespace {

bool is_candidate(const std::vector<Candidate>& list, std::string_view effect, std::string_view key = "") {
  return std::any_of(list.begin(), list.end(), [&](const Candidate& candidate) {
    return candidate.effect == effect && (key.empty() || candidate.fitted_knobs().at(0).key == key);
  });
}

std::vector<Candidate> candidates_of(const shakedown::Setup& setup, KnownEffects known = all_effects()) {
  return candidates_for(setup, {}, known, *engine_named("hard"));
}

}  // namespace

TEST(Candidates, WhatARecordSaysNoDiagnosisLooksForIsNone) {
  const std::vector<Candidate> list = candidates_of({});
  for (const EffectRecord* record : all_effects())
    EXPECT_FALSE(!record->search.not_searched.empty() && is_candidate(list, record->name)) << record->name;
}

TEST(Candidates, WhatDoesNothingWithoutAnotherIsOneBesideIt) {
  shakedown::Setup setup;
  EXPECT_FALSE(is_candidate(candidates_of(setup), "grain_rolling_resistance"));
  set_number(setup, "grain_friction.grain_wall", 0.2, all_effects());
  EXPECT_TRUE(is_candidate(candidates_of(setup), "grain_rolling_resistance"));
}

TEST(Candidates, WhatTheEngineDoesNotModelIsNone) {
  EffectRecord brake = brake_of_tomorrow();
  brake.engines = {{"soft", {Fidelity::exact, ""}}};
  std::vector<const EffectRecord*> known(all_effects().begin(), all_effects().end());
  known.push_back(&brake);
  EXPECT_FALSE(is_modelled(*engine_named("hard"), brake));
  EXPECT_FALSE(is_candidate(candidates_of({}, known), "cubic_brake"));
  EXPECT_TRUE(is_candidate(candidates_of({}, known), "grain_cohesion"));
}

TEST(Candidates, TwoEffectsWithOneClaimAreNeverBothInTheModel) {
  shakedown::Setup setup;
  set_number(setup, "fluctuating_restitution.deviation", 0.05, all_effects());
  EXPECT_FALSE(is_candidate(candidates_of(setup), "velocity_dependent_restitution"));
}

TEST(Candidates, AnotherComponentOfAnEffectThatIsThereStaysACandidate) {
  shakedown::Setup setup;
  set_number(setup, "constant_acceleration.acceleration.x", 0.1, all_effects());
  const std::vector<Candidate> list = candidates_of(setup);
  EXPECT_FALSE(is_candidate(list, "constant_acceleration", "constant_acceleration.acceleration.x"));
  EXPECT_TRUE(is_candidate(list, "constant_acceleration", "constant_acceleration.acceleration.z"));
}

TEST(Candidates, AreLookedAtByOddsForCost) {
  const auto with = [](double odds, bool slow, bool dear) {
    Candidate candidate;
    candidate.prior.odds = odds, candidate.slow = slow, candidate.dear = dear;
    return candidate;
  };
  // Attraction in one of four forms, a usual effect, drag that air hardly has, friction.
  EXPECT_EQ(by_odds_for_cost({with(0.034, true, false), with(1, false, false), with(0.005, true, false),
                              with(1, false, true)}),
            (std::vector<std::size_t>{1, 3, 0, 2}));
}
