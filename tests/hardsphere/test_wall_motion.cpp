// SPDX-License-Identifier: MIT
#include "wall_motion.hpp"

#include <gtest/gtest.h>

using namespace shakedown;

namespace {

/// A box released at rest in its middle and shaken, one that sticks and slides, one on a cubic spring.
std::vector<Physics> driven_boxes() {
  Physics shaken;
  shaken.box_mass = 0.434;
  shaken.stiffness = 25.92;
  shaken.box.harmonics.push_back({0.3, 2, 0.4, -1});
  Physics sticks = shaken, cubic = shaken;
  sticks.box.dry_friction.add(0.25, 0);
  cubic.spring_cubic = 50;
  return {shaken, sticks, cubic};
}

}  // namespace

TEST(DrivenWalls, KeepToTheirBoundsOnEveryPiece) {
  for (const Physics& physics : driven_boxes())
    for (const double release : {0.0, 0.03}) {
      DrivenBox box(physics, release, 0);
      const FallingFrame frame(physics.grains);
      const DrivenWalls across{&box, &frame, 2, 0.6 / 0.59, release};
      for (double start = 0; start < 2;) {
        const double end = std::min(box.valid_until(), 2.0), step = (end - start) / 200;
        for (int k = 1; k < 200; ++k) {
          const double t = start + k * step;
          const double acceleration = (across.at(t + step / 2).v - across.at(t - step / 2).v) / step;
          EXPECT_LE(std::abs(acceleration), across.top_acceleration() * (1 + 1e-9) + 1e-12) << t;
          EXPECT_LE(std::abs(box.at(t).x), box.top_reach().x * (1 + 1e-12)) << t;
          EXPECT_LE(std::abs(box.at(t).v), box.top_reach().v * (1 + 1e-12)) << t;
        }
        start = end;
        if (end < 2) box.go_on();
      }
    }
}
