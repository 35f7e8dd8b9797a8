// SPDX-License-Identifier: MIT
#include "wall_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "within.hpp"

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

/// Work and impulse that a box accounts for, against sums over many short times of the forces of its motion.
TEST(DrivenBox, AccountsForTheIntegralsOfItsForces) {
  Physics physics;
  physics.box_mass = 0.434;
  physics.stiffness = 25.92;
  physics.box.viscous.add(0.05, 0);
  physics.box.constant.add(0.3, 1);
  physics.box.dry_friction.add(0.02, 2);
  for (const double damping : {0.05, 1e-9, 0.0}) {
    if (damping != 0.05) physics.box.viscous = {};
    if (damping == 1e-9) physics.box.viscous.add(damping, 0);
    DrivenBox box(physics, 0.1, 0.2);
    std::array<double, 3> work{};
    double impulse = 0, worst = 0;
    for (int piece = 0; piece < 12; ++piece) {
      // whole pieces, and some cut short by a kick
      const double start = box.time(), kick = start + std::pow(10, -piece / 2) / 20;
      const bool kicked = piece % 2 == 1 && kick < box.valid_until();
      const double end = kicked ? kick : box.valid_until();
      const double direction = box.at(start + (end - start) / 2).v > 0 ? 1 : -1;
      constexpr int steps = 2000;
      for (int k = 0; k <= 2 * steps; ++k) {  // Simpson
        const double weight = (end - start) / (6 * steps) *
                              (k == 0 || k == 2 * steps ? 1
                               : k % 2 == 1             ? 4
                                                        : 2);
        const BoxMotion::Point at = box.at(start + (end - start) * k / (2 * steps));
        const double viscous = -damping * at.v, dry = -0.02 * direction;
        work[0] += weight * viscous * at.v;
        work[1] += weight * 0.3 * at.v;
        work[2] += weight * dry * at.v;
        impulse += weight * (viscous + 0.3 + dry - physics.stiffness * at.x);
      }
      box.account(start + (end - start) / 3);
      box.account(end);
      for (std::size_t effect = damping == 0 ? 1 : 0; effect < 3; ++effect)
        worst = std::max(worst, std::abs(box.effect_work()[effect] - work[effect]));
      worst = std::max(worst, std::abs(box.outer_impulse() - impulse));
      if (kicked)
        box.restart(end, box.at(end).x, box.at(end).v + 0.05);
      else
        box.go_on();
    }
    std::printf("work and impulse differ by %.1e\n", worst);
    WITHIN(worst, 0, 5e-13, 5e-14);  // J and N s
  }
}
