// SPDX-License-Identifier: MIT
// One grain between the end walls of the swinging box: everything that happens is known, so the engine is
// held against a solution of its own in extended precision that shares no code and no method with it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "hard_sphere_system.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

using Real = long double;

/// Box and grain by hand: time of the next impact by steps no longer than the curvature bound allows (each
/// reaches the root from below).
struct ByHand {
  Real mass, box_mass, w, room, restitution, elastic_fraction;
  Real x, v, box_x, box_v, time = 0, closing = 0;

  Real top_speed() const { return std::hypot(box_x * w, box_v); }
  void fly(Real h) {
    const Real c = std::cos(w * h), s = std::sin(w * h), x0 = box_x;
    box_x = x0 * c + box_v / w * s;
    box_v = box_v * c - x0 * w * s;
    x += v * h;
    time += h;
  }
  /// Time in which the gap on one side cannot close.
  Real safe(int side) const {
    const Real gap = std::max(Real(0), side * (box_x - x) + room), rate = side * (box_v - v),
               curvature = top_speed() * w;
    return rate >= 0 ? (rate + std::sqrt(rate * rate + 2 * curvature * gap)) / curvature
                     : 2 * gap / (std::sqrt(rate * rate + 2 * curvature * gap) - rate);
  }
  void next_impact() {
    for (;;) {
      const Real upper = safe(1), lower = safe(-1), step = std::min(upper, lower);
      fly(step);
      const int side = upper < lower ? 1 : -1;
      if (step < 1e-17L && side * (v - box_v) > 0) return hit(side);
    }
  }
  void hit(int side) {
    closing = side * (v - box_v);
    const Real e = closing < elastic_fraction * top_speed() ? 1 : restitution;
    const Real impulse = mass * box_mass / (mass + box_mass) * (1 + e) * closing;
    v -= side * impulse / mass;
    box_v += side * impulse / box_mass;
  }
};

struct Case {
  double grain_mass, length, restitution, start, speed;
};

// As in the paper; heavy, so that the box feels it; elastic; in the optimum's long box; nearly at rest
// against a wall.
constexpr std::array<Case, 5> cases{{{4.04e-3, 0.04, 0.76, 0.0, 0.1},
                                     {0.2, 0.04, 0.9, 0.003, -0.5},
                                     {4.04e-3, 0.104, 1.0, 0.01, 0.3},
                                     {0.02, 0.311, 0.95, -0.1, 0.05},
                                     {4.04e-3, 0.065, 0.76, 0.0274, -1e-3}}};

HardSphereSystem system_of(const Case& c) {
  shakedown::Setup setup;
  setup.grains.count = 1;
  setup.grains.mass = c.grain_mass;
  setup.box.length = c.length;
  setup.restitution.grain_wall = c.restitution;
  return {
      setup,
      State{{Vec3(0.1075 + c.start, 0, 0)}, {Vec3(c.speed, 0, 0)}, {}, {0.005}, {c.grain_mass}, 0.1075, 0}};
}

ByHand by_hand(const Case& c, const State& state, Real time) {
  return {c.grain_mass,
          0.434,
          2 * std::numbers::pi_v<Real> * Real(1.23),
          Real(c.length) / 2 - Real(0.005),
          c.restitution,
          0.02L,
          state.position[0].x(),
          state.velocity[0].x(),
          state.x_box,
          state.v_box,
          time};
}

TEST(SingleGrain, GoesFromImpactToImpactToTheLastDigits) {
  double worst_time = 0, worst_speed = 0;
  for (const Case& c : cases) {
    HardSphereSystem system = system_of(c);
    for (int impact = 1; impact <= 50; ++impact) {
      ByHand hand = by_hand(c, system.state(), system.time());
      const double before = system.time();
      system.advance_impacts(1);
      hand.next_impact();
      const State now = system.state();
      // What half a unit in the last place of a position or of the clock is worth in time at this closing
      // speed.
      const double rounding = 0x1p-53 * (0.12 / static_cast<double>(hand.closing) + system.time()) *
                              (1 + 8 * (system.time() - before));
      worst_time = std::max(worst_time, std::abs(system.time() - static_cast<double>(hand.time)) / rounding);
      worst_speed = std::max(
          {worst_speed, std::abs(now.velocity[0].x() - static_cast<double>(hand.v)) / (8 * rounding + 1e-16),
           std::abs(now.v_box - static_cast<double>(hand.box_v)) / (8 * rounding + 1e-16)});
      ASSERT_EQ(system.collisions()[1], impact);
    }
  }
  std::printf("impact times and speeds off by at most %.1f and %.1f roundings\n", worst_time, worst_speed);
  EXPECT_LE(worst_time, 20);
  EXPECT_LE(worst_speed, 20);
}

/// Over many impacts small errors grow, so the yardstick is a second solution by hand that starts 1e-15 m
/// away.
TEST(SingleGrain, StaysWithTheHandWrittenSolutionAsLongAsChaosLetsIt) {
  for (const Case& c : cases) {
    HardSphereSystem system = system_of(c);
    ByHand hand = by_hand(c, system.state(), 0), neighbour = hand;
    neighbour.x += 1e-15L;
    double off = 0, chaos = 1e-14;
    for (int impact = 0; impact < 50; ++impact) {
      system.advance_impacts(1);
      hand.next_impact();
      neighbour.next_impact();
      off = std::max(off, std::abs(system.time() - static_cast<double>(hand.time)));
      chaos = std::max(chaos, static_cast<double>(std::abs(neighbour.time - hand.time)));
      EXPECT_LE(off, 20 * chaos);
    }
    std::printf(
        "m = %g kg, L = %g m, eps = %g: 50 impacts in %.3f s, off by %.1e s; 1e-15 m off at the start: %.1e "
        "s\n",
        c.grain_mass, c.length, c.restitution, system.time(), off, chaos);
    EXPECT_LE(chaos, 1e-4);  // or the test says nothing
  }
}

/// A grain so light that the box does not feel it, bouncing on a wall that comes at it with acceleration a =
/// Delta0 Omega^2: after a first impact at speed u0 impact k comes at closing speed u0 eps^(k-1) and, were
/// there no limit, infinitely many in 2 eps u0 / (a (1 - eps)).
class Bouncing : public ::testing::Test {
 protected:
  static constexpr double eps = 0.76, mass = 1e-9;
  double first = 1e-4;  // m/s
  const double w = 2 * std::numbers::pi * 1.23, acceleration = 0.1075 * w * w, top_speed = 0.1075 * w;

  HardSphereSystem system(double elastic_fraction) const {
    shakedown::Setup setup;
    setup.grains.count = 1;
    setup.grains.mass = mass;
    setup.restitution.grain_wall = eps;
    setup.hard.wall_elastic_fraction = elastic_fraction;
    const State start{{Vec3(0.1075 + 0.015, 0, 0)}, {Vec3(first, 0, 0)}, {}, {0.005}, {mass}, 0.1075, 0};
    return HardSphereSystem(setup, start);
  }
};

TEST_F(Bouncing, ComesToRestInZenosTime) {
  HardSphereSystem grain = system(1e-9);
  const double zeno = 2 * eps * first / (acceleration * (1 - eps));
  for (int k = 1; k <= 14; ++k) {
    grain.advance_impacts(1);
    // the wall's acceleration changes by 4e-7
    WITHIN(grain.time() / zeno, 1 - std::pow(eps, k - 1), 1e-6, 9.9e-8) << k;
  }
  EXPECT_EQ(grain.health().elastic_rescues, 0);
}

TEST_F(Bouncing, IsCutShortByTheElasticLimitAtItsCurrentTopSpeed) {
  const double limit = 1.5e-5;
  HardSphereSystem grain = system(limit / top_speed);
  // closing speeds first eps^(k-1) >= limit
  const int inelastic = static_cast<int>(std::ceil(std::log(limit / first) / std::log(eps)));
  grain.advance_impacts(inelastic);
  EXPECT_EQ(grain.health().elastic_rescues, 0);
  const double lost = mass / 2 * first * first * (1 - std::pow(eps, 2 * inelastic));
  WITHIN(grain.ledger().contact_loss[1] / lost, 1, 1e-7, 5.3e-9);  // (the wall moves)
  // From here on it bounces for ever with the speed it has, the last 2 u / (a (1 - eps)) of Zeno's time never
  // pass.
  const double speed = first * std::pow(eps, inelastic), time = grain.time();
  grain.advance_impacts(20);
  EXPECT_EQ(grain.health().elastic_rescues, 20);
  WITHIN(20 * 2 * speed / acceleration / (grain.time() - time), 1, 1e-5, 1.2e-6);
  WITHIN(grain.ledger().contact_loss[1] / lost, 1, 1e-7, 5.3e-9);
}

/// Bounces lower than a position's last digit must not hold time up. (Among 1e4 grains one such speed turns
/// up every few million impacts.)
TEST_F(Bouncing, DoesNotStickToTheWallAtSpeedsThatPositionsDoNotResolve) {
  for (const double speed : {1e-16, 4e-10, 1e-8}) {
    first = speed;
    for (const double limit : {0.0, 0.02}) {
      HardSphereSystem grain = system(limit);
      grain.advance_to(0.001);
      EXPECT_LT(grain.collisions()[1], 4000) << speed;  // of 0.36 us each
      grain.observe();
      EXPECT_LE(grain.health().ledger_error, 1e-12);
      // metre; rounding adds up while the bounces repeat: seen 8e-15
      EXPECT_LE(grain.health().deepest_overlap, 1e-13);
      EXPECT_GT(grain.ledger().contact_loss[1], -1e-12 * grain.initial_energy());
    }
  }
}

}  // namespace
