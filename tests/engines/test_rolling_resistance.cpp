// SPDX-License-Identifier: MIT
// Rolling resistance: closed forms of one impact and of a ball on a floor, hard against soft over angles, and
// the books of a damper.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "referees.hpp"
#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// A sphere that spins and meets its partner along the normal, so smooth that only its rolling is resisted.
Encounter spinning_sphere(Partner partner, double surface_speed) {
  Encounter it = meets(partner, 0, 0.3);
  const auto& [normal, tangent] = place_of(partner);
  it.spin = surface_speed / it.radius * normal.cross(tangent);
  it.friction = 1e-9;
  it.rolling_resistance = 0.1;
  it.steps_per_contact = 200;
  return it;
}

double turning(const Encounter& it, const Vec3& spin) {
  const auto& [normal, tangent] = place_of(it.partner);
  return spin.dot(normal.cross(tangent)) * it.radius;
}

}  // namespace

TEST(RollingResistance, TakesItsCoefficientTimesTheNormalImpulse) {
  for (const char* engine : {"hard", "soft"})
    for (const Partner partner : every_partner) {
      SCOPED_TRACE(std::string(engine) + ", " + partner_names[static_cast<std::size_t>(partner)]);
      const Encounter it = spinning_sphere(partner, 0.5);
      const Motion after = impact_by(engine, it).motion;
      const double impulse = it.reduced_mass() * (1 + it.restitution) * it.closing(),
                   lever = partner == Partner::grain ? 0.5 : 1.0,
                   lost = 2.5 * 0.1 * lever * impulse / it.mass;
      WITHIN(turning(it, after.spin), 0.5 - lost, 2e-5, 1.4e-6);
      if (partner == Partner::grain) {
        WITHIN(turning(it, after.other_spin), lost, 1e-6, 5.3e-8);
      }
    }
}

TEST(RollingResistance, StopsTheRollingAndNeverTurnsIt) {
  for (const char* engine : {"hard", "soft"}) {
    const Encounter wall = spinning_sphere(Partner::held_wall, 0.01),
                    pair = spinning_sphere(Partner::grain, 0.01);
    WITHIN(turning(wall, impact_by(engine, wall).motion.spin) / 0.01, 0, 5e-10, 5.1e-11) << engine;
    const Motion after = impact_by(engine, pair).motion;  // they go on together
    WITHIN(turning(pair, after.spin) / 0.01, 0.5, 1e-6, 6.6e-8) << engine;
    WITHIN(turning(pair, after.other_spin) / 0.01, 0.5, 1e-6, 6.6e-8) << engine;
  }
}

/// Spin about the normal is no rolling.
TEST(RollingResistance, LeavesTheSpinAboutTheNormal) {
  for (const char* engine : {"hard", "soft"}) {
    Encounter it = spinning_sphere(Partner::held_wall, 0);
    it.spin = 40 * place_of(it.partner).normal;
    EXPECT_EQ(impact_by(engine, it).motion.spin, it.spin) << engine;
  }
}

/// A ball that rolls on a floor is slowed by 5/7 mu_r g, and comes to rest.
TEST(RollingResistance, BringsARollingBallToRest) {
  constexpr double coefficient = 0.05, slowing = 5.0 / 7 * coefficient * 9.81;
  const Roll ball{.speed = 0.1, .backspin = -1, .rolling_resistance = coefficient};
  const double stops = ball.speed / slowing;
  for (const double share : {0.3, 0.7}) {
    const Rolled rolled = roll("soft", ball, share * stops);
    WITHIN(rolled.speed / ball.speed, 1 - share, 1e-2, 1.7e-3);
    WITHIN(rolled.surface_speed / ball.speed, 1 - share, 2e-2, 3.9e-3);
  }
  EXPECT_LT(std::abs(roll("soft", ball, 1.2 * stops).speed) / ball.speed, 1e-12);
}

/// At a wall friction and rolling resistance act on each other. What is left is soft contacts' steps: with 50
/// in a contact spins at walls are 0.075 apart.
TEST(RollingResistance, IsAlikeInHardAndSoftAtAnyAngle) {
  double worst_pair = 0, worst_wall = 0;
  for (const Partner partner : every_partner)
    for (const double ratio : {ContactLaw::turning_ratio, 0.82})
      for (const double resistance : {0.05, 0.3})
        for (int degrees = 5; degrees <= 85; degrees += 10)
          for (const double spin : {-1.0, 0.0, 1.0}) {
            Encounter it = meets(partner, degrees, 0.3);
            const auto& [normal, tangent] = place_of(partner);
            it.spin = spin * 0.3 / it.radius * (normal.cross(tangent) + 0.5 * tangent);
            it.friction = 0.3;
            it.stiffness_ratio = ratio;
            it.rolling_resistance = resistance;
            it.contact_time = 1e-5;
            it.steps_per_contact = 200;
            const Outcome hard = impact_by("hard", it), soft = impact_by("soft", it);
            EXPECT_LE(hard.energy_gained, 1e-15);
            EXPECT_LE(soft.energy_gained, 0);
            const double off = it.radius * (hard.motion.spin - soft.motion.spin).norm() / it.velocity.norm();
            double& worst = partner == Partner::grain ? worst_pair : worst_wall;
            worst = std::max(worst, off);
          }
  WITHIN(worst_pair, 0, 0.05, 0.0143);
  WITHIN(worst_wall, 0, 0.07, 0.0195);
}

TEST(SlowRollingResistance, ClosesTheBooksOfADamper) {
  for (const EngineUnderTest& tested : engines_that_model("grain_rolling_resistance")) {
    shakedown::Setup setup;
    setup.run.duration = 1;
    add_effect(setup, "grain_friction", {{"grain_grain", 0.3}, {"grain_wall", 0.3}});
    const auto engine = tested.make();
    const Trajectory plain = engine->run(setup);
    add_effect(setup, "grain_rolling_resistance", {{"grain_grain", 0.3}, {"grain_wall", 0.3}});
    const Trajectory run = engine->run(setup);
    EXPECT_LE(run.health.ledger_error, tested.ledger_error) << tested.name;
    EXPECT_NE(run.x_box, plain.x_box) << tested.name;
    for (const double loss : run.ledger.contact_loss) EXPECT_GE(loss, 0) << tested.name;
  }
}
