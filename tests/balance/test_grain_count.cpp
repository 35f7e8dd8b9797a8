// SPDX-License-Identifier: MIT
#include "grain_count.hpp"

#include <gtest/gtest.h>

#include "effects.hpp"
#include "pushed_box.hpp"

namespace shakedown {
namespace {

/// What the balance says of a count of `counted` grains where 37 are in the box.
struct Counted {
  std::vector<GrainCount> counts;
  int in_question;
};
Counted counted(int count, const PushedBox& what = {}) {
  const Experiment experiment = pushed_box(what, 3);
  std::vector<Setup> setups = pushed_setups(experiment);
  for (Setup& setup : setups) setup.grains.count = count;
  const Measurement measurement = measurement_of(setups, experiment);
  MomentumOptions options;
  options.formulas = false;
  const MomentumAudit audit = audit_momentum(measurement, all_effects(), options);
  const std::vector<GrainCount> counts = grain_counts(measurement, all_effects(), audit);
  return {counts, miscount_in_question(counts, audit)};
}

TEST(SlowGrainCount, OneTooManyOrTooFewIsSeen) {
  for (const int count : {36, 38}) {
    const Counted found = counted(count);
    EXPECT_EQ(found.in_question, 37 - count);
    ASSERT_EQ(found.counts.size(), 2u);
    EXPECT_GT(found.counts.front().log_odds, 5);  // 6.6 and more seen
    EXPECT_LT(found.counts.back().log_odds, 0);
  }
}

TEST(SlowGrainCount, ThatIsRightIsNotAskedAbout) {
  EXPECT_EQ(counted(37).in_question, 0);
  PushedBox what;
  what.viscous = 0.02;
  EXPECT_EQ(counted(37, what).in_question, 0);
}

TEST(GrainCount, OfABoxWithoutGrainsOrWithOneIsNoQuestion) {
  PushedBox what;
  what.grains = false;
  MomentumAudit possible;
  possible.possible = true;
  for (const int count : {0, 1}) {
    const Experiment experiment = pushed_box(what, 3);
    auto setups = pushed_setups(experiment);
    for (auto& setup : setups) setup.grains.count = count;
    EXPECT_TRUE(grain_counts(measurement_of(setups, experiment), all_effects(), possible).empty());
  }
}

}  // namespace
}  // namespace shakedown
