// SPDX-License-Identifier: MIT
// What contacts do beside the plain restitution, against closed forms.
#include <cmath>

#include "soft_effects.hpp"
#include "within.hpp"

using namespace shakedown;

TEST_F(SoftEffects, SlidingBallComesToRollAtFiveSevenths) {
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int index, Physics& physics) {
                                         physics.contact.friction = {0.3, 0.3, 0.3};
                                         physics.grains.constant.add(Vec3(0, 0, -9.81), index);
                                       }},
                                       {{-0.08, 0, -0.095, 0.5, 0, 0}});
  setup.run.duration = 0.25;
  const Trajectory result = run(setup);
  const std::size_t last = result.time.size() - 1;
  const double speed =
      (result.x_com[last] - result.x_com[last - 25]) / (result.time[last] - result.time[last - 25]);
  WITHIN(speed / 0.5, 5.0 / 7, 1e-4, 7.2e-6);           // lever R - overlap
  const double sliding = 2.0 / 7 * 0.5 / (0.3 * 9.81);  // s
  const auto k = static_cast<std::size_t>(std::lround(0.5 * sliding * 500));
  const double t = result.time[k];
  WITHIN(result.x_com[k], -0.08 + 0.5 * t - 0.5 * 0.3 * 9.81 * t * t, 1e-5, 1.2e-6);
}

TEST_F(SoftEffects, ObliqueImpactSlipsByCoulombsLaw) {
  const double normal = 0.5, across = 1.0, m = 4.04e-3;
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int, Physics& physics) {
                                         physics.contact.friction = {0, 0, 0.1};
                                       }},
                                       {{0, 0, -0.0949, across, 0, -normal}});
  setup.soft.steps_per_contact = 50;
  setup.run.duration = 4e-3;
  const Trajectory result = run(setup);
  const double impulse = 0.1 * 1.76 * normal;  // per mass
  const double spin = 2.5 * impulse / 0.005;
  const double before = m / 2 * (normal * normal + across * across);
  const double after = m / 2 * (0.76 * 0.76 * normal * normal + (across - impulse) * (across - impulse)) +
                       0.2 * m * 0.005 * 0.005 * spin * spin;
  WITHIN(result.ledger.contact_loss[2] / (before - after), 1, 0.01, 9.3e-4);
}

TEST_F(SoftEffects, FrictionWithoutSlidingReversesTheSlipAndLosesNothing) {
  const double normal = 0.5, across = 0.1, m = 4.04e-3;
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int, Physics& physics) {
                                         physics.contact.friction = {0, 0, 10};
                                       }},
                                       {{0, 0, -0.0949, across, 0, -normal}});
  setup.soft.steps_per_contact = 50;
  setup.run.duration = 4e-3;
  const Trajectory result = run(setup);
  WITHIN(result.ledger.contact_loss[2] / (m / 2 * normal * normal * (1 - 0.76 * 0.76)), 1, 4e-3, 2.2e-4);
  const std::size_t last = result.time.size() - 1;
  const double speed =
      (result.x_com[last] - result.x_com[last - 1]) / (result.time[last] - result.time[last - 1]);
  // Slip u' = -u with solid spheres: v' = v - (2/7)(1 + 1) u = (3/7) v.
  WITHIN(speed / across, 3.0 / 7, 0.02, 5.4e-3);
}

TEST_F(SoftEffects, FrictionInTheDamperKeepsTheBooks) {
  shakedown::Setup setup = with({[](const EffectChoice&, int, Physics& physics) {
    physics.contact.friction = {0.3, 0.2, 0.1};
    physics.contact.tangential_restitution = 0.5;
  }});
  const Trajectory result = run(setup);
  EXPECT_GT(result.ledger.contact_loss[2], 0);
}

TEST_F(SoftEffects, AttractionCapturesSlowPairs) {
  const auto attraction = [](const EffectChoice&, int, Physics& physics) {
    physics.contact.attraction_force = 0.1;
    physics.contact.attraction_range = 1e-4;
  };
  // Well of 1e-5 J; a pair at speed v leaves it when mu (eps v_in)^2 / 2 > 1e-5 J, v_in^2 = v^2 + 2e-5 J /
  // mu.
  const double mu = 2.02e-3, well = 1e-5;
  const double limit = std::sqrt(2 * well / mu * (1 / (0.75 * 0.75) - 1));
  for (const double factor : {0.8, 1.2}) {
    const double v = factor * limit;
    shakedown::Setup setup =
        closed_cube({attraction}, {{-0.0053, 0, 0, v / 2, 0, 0}, {0.0053, 0, 0, -v / 2, 0, 0}});
    setup.run.duration = 0.1;
    const Trajectory result = run(setup);
    if (factor > 1) {
      EXPECT_EQ(result.collisions[0], 1);
      const double inside = v * v + 2 * well / mu;
      WITHIN(result.ledger.contact_loss[0] / (mu / 2 * inside * (1 - 0.75 * 0.75)), 1, 0.05, 0.037);
    } else {
      EXPECT_GT(result.collisions[0], 1);
      EXPECT_LT(result.total_energy.back(), -0.9 * well);
    }
  }
}

TEST_F(SoftEffects, RestitutionFollowsTheClosingSpeed) {
  const auto law = [](const EffectChoice&, int, Physics& physics) {
    physics.contact.restitution_at = [](ContactClass, double v) { return 0.9 / (1 + v); };
  };
  for (const double v : {0.05, 0.5}) {
    shakedown::Setup setup = closed_cube({law}, {{-0.0051, 0, 0, v / 2, 0, 0}, {0.0051, 0, 0, -v / 2, 0, 0}});
    setup.run.duration = 0.01;
    const Trajectory result = run(setup);
    const double energy = 2.02e-3 * v * v / 2, wanted = 0.9 / (1 + v);
    WITHIN(std::sqrt(1 - result.ledger.contact_loss[0] / energy), wanted, 4e-3, 1.2e-3);
  }
}

TEST_F(SoftEffects, OwnForceByOverlapKeepsTheBooks) {
  // Hertz with a dashpot of Tsuji's kind: restitution does not depend on speed.
  const auto law = [](const EffectChoice&, int, Physics& physics) {
    physics.contact.push = [](ContactClass, double overlap, double rate, double, double reduced_mass) {
      const double k = 5e7;
      return k * std::pow(overlap, 1.5) + 0.3 * std::sqrt(reduced_mass * k) * std::pow(overlap, 0.25) * rate;
    };
    physics.contact.stored_energy = [](ContactClass, double overlap, double, double) {
      return 0.4 * 5e7 * std::pow(overlap, 2.5);
    };
  };
  std::vector<double> restitution;
  for (const double v : {0.05, 0.5}) {
    shakedown::Setup setup = closed_cube({law}, {{-0.0051, 0, 0, v / 2, 0, 0}, {0.0051, 0, 0, -v / 2, 0, 0}});
    setup.run.duration = 0.01;
    setup.soft.steps_per_contact = 100;
    restitution.push_back(std::sqrt(1 - run(setup).ledger.contact_loss[0] / (2.02e-3 * v * v / 2)));
  }
  WITHIN(restitution[0], restitution[1], 2e-3, 1.3e-3);
  EXPECT_LT(restitution[0], 0.9);
  EXPECT_GT(restitution[0], 0.5);
}

TEST_F(SoftEffects, GrainsOfManySizesKeepTheBooks) {
  const Trajectory result = run(with({[](const EffectChoice&, int, Physics& physics) {
    physics.relative_diameter_deviation = 0.05;
    physics.packing = Packing::random;
  }}));
  EXPECT_GT(result.collisions[0], 1000);
}

TEST_F(SlowSoftEffects, AddUp) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
                                   physics.contact.friction = {0.2, 0.2, 0.2};
                                   physics.box.dry_friction.add(0.05, index);
                                 },
                                 [](const EffectChoice&, int index, Physics& physics) {
                                   physics.grains.constant.add(Vec3(0.1, 0, -0.2), index);
                                   physics.box.constant.add(physics.box_mass * 0.1, index);
                                 },
                                 [](const EffectChoice&, int index, Physics& physics) {
                                   physics.grains.drag.add({1e-4, 0}, index);
                                   physics.contact.attraction_force = 1e-3;
                                   physics.contact.attraction_range = 1e-5;
                                   physics.spring_cubic = -10;
                                 }});
  const Trajectory result = run(setup);
  EXPECT_GT(result.ledger.effect_loss[0], 0);
  EXPECT_NE(result.ledger.effect_loss[1], 0);
  EXPECT_GT(result.ledger.effect_loss[2], 0);
}
