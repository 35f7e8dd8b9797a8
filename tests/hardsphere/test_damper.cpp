// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "hard_engine.hpp"

using namespace shakedown;

TEST(HardDamper, KeepsItsPromisesOverThirtySeconds) {
  for (const double length : {0.040, 0.065, 0.085, 0.104, 0.311}) {
    shakedown::Setup setup;
    setup.box.length = length;
    setup.run.duration = 30;
    const Trajectory trajectory = make_hard_engine()->run(setup);
    EXPECT_LE(trajectory.health.ledger_error, 1e-12) << length;       // promised; seen 3e-14
    EXPECT_LE(trajectory.health.momentum_error, 1e-12) << length;     // promised
    EXPECT_LE(trajectory.health.deepest_overlap, 1e-12) << length;    // promised; seen 4e-16 m
    EXPECT_EQ(trajectory.time.size(), 15001u);
  }
}
