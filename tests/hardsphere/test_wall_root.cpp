// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <numbers>

#include "wall_root_proof.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double w = 2 * std::numbers::pi * 1.23;

TEST(WallRoot, MissesNoneAndInventsNone) {
  const WallRootSurvey survey = survey_wall_roots(10'000, 7);
  EXPECT_EQ(survey.wrong(), 0) << survey.first_wrong;
  for (std::size_t k = 0; k < survey.kinds.size(); ++k)
    EXPECT_GT(survey.kinds[k].roots, 100) << wall_root_case_names[k];
}

/// The proof itself must be able to fail.
TEST(WallRootProof, RefutesWrongAnswers) {
  const HarmonicGap gap{0.1, 0, w, -0.05, 0};  // closes at cos Wt = 1/2
  const double root = std::acos(0.5) / w;
  EXPECT_EQ(prove(gap, root).verdict, WallRootVerdict::right);
  EXPECT_EQ(prove(gap, root * (1 + 1e-13)).verdict, WallRootVerdict::missed);
  EXPECT_EQ(prove(gap, root * (1 - 1e-13)).verdict, WallRootVerdict::early);
  EXPECT_EQ(prove(gap, never).verdict, WallRootVerdict::missed);
  EXPECT_EQ(prove({0.1, 0.1, w, -0.1, 0}, 0).verdict, WallRootVerdict::redetected);
}

TEST(WallRoot, LeavesAGapOfZeroThatOpens) {
  // Opens from zero at W b, is back at zero where cos Wt + sin Wt = 1 again: a quarter turn on.
  WITHIN(first_wall_root({0.1, 0.1, w, -0.1, 0}), 0.25 / 1.23, 1e-15, 5e-17);
  // At rest relative to the wall at the crest: the wall falls away from the grain, there and then.
  EXPECT_EQ(first_wall_root({-0.1, 0, w, 0.1, -1.0}), never);
  EXPECT_EQ(first_wall_root({0.1, 0, w, -0.1, 1e-9}), 0);
}

TEST(WallRoot, FollowsAGrainThatOutrunsTheWall) {
  EXPECT_EQ(first_wall_root({0.1, 0.02, w, 0.3, -2.0}), never);
  const double t = first_wall_root({0, 0, w, 0.3, 2.0});
  EXPECT_DOUBLE_EQ(t, 0.15);
}

TEST(WallRoot, FindsTheTangentThatADropHitsAndAHairMisses) {
  // Lowest at half a turn: c - R. The least double above R stays clear for ever, R itself touches.
  WITHIN(first_wall_root({0.1, 0, w, 0.1, 0}), 0.5 / 1.23, 1e-8, 2.2e-9);
  EXPECT_EQ(first_wall_root({0.1, 0, w, std::nextafter(0.1, 1.0), 0}), never);
}

}  // namespace
