// SPDX-License-Identifier: MIT
// A shaken box without gravity: above an amplitude of L_g/pi its grains go as one and lose what the closed
// form says, below they do not. The tables are in bench/results/2026-11-27-shaken-box.md.
#include <gtest/gtest.h>

#include "shaken_box.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

ShakenLoss at(const char* engine, double amplitude_over_clearance) {
  ShakenBox box;
  box.amplitude = amplitude_over_clearance * box.clearance;
  box.settling = 10;
  box.periods = 10;
  return loss_of(engine, box);
}

}  // namespace

TEST(ShakenBox, ClosedFormIsLargestWhereTheWallMeetsThemAtItsFastest) {
  WITHIN(collected_loss(3.14159265358979), 4, 1e-12, 1e-13);
  EXPECT_LT(collected_loss(3), 4);
  EXPECT_LT(collected_loss(1), collected_loss(2));
}

/// Hard grains stop in each other however slightly each impact is elastic; soft ones that lie together when
/// they are hit are pressed together all at once, give part of it back, and soon go as one no more.
TEST(SlowShakenBox, LosesWhatGrainsThatGoAsOneLose) {
  for (const double ratio : {0.31, 0.35, 0.5, 1.0})
    WITHIN(at("hard", ratio).mean / collected_loss(1 / ratio), 1, 0.01, 6e-4) << ratio;
  WITHIN(at("soft", 0.35).mean / collected_loss(1 / 0.35), 1, 0.2, 0.04);
  EXPECT_LT(at("soft", 1).mean / collected_loss(1), 0.5);
}

TEST(ShakenBox, LosesHalfBelow) {
  WITHIN(at("hard", 0.28).mean, 3.66, 0.07, 3.7e-3);
  for (const char* engine : {"hard", "soft"}) EXPECT_LT(at(engine, 0.2).mean, 2) << engine;
}
