// SPDX-License-Identifier: MIT
// Side walls by laws of their own, whatever those of the other contacts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double radius = 0.005;

shakedown::Setup resting_box() {
  shakedown::Setup setup;
  setup.release.displacement = 0;
  setup.spring.frequency = 1e-6;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.1;
  setup.soft.steps_per_contact = 100;
  setup.run.duration = 4e-3;
  setup.run.sample_rate = 250;
  return setup;
}

/// State after a grain has met the wall across this axis.
State met(const Engine& engine, const shakedown::Setup& setup, int axis, const Vec3& velocity) {
  Vec3 place = Vec3::Zero();
  place[axis] = 0.05 - radius - 1.5e-3 * velocity[axis];
  return run_with(engine, setup, {{place, velocity}}).end_state;
}

double restitution(const Engine& engine, const shakedown::Setup& setup, int axis, double speed) {
  Vec3 velocity = Vec3::Zero();
  velocity[axis] = speed;
  const State end = met(engine, setup, axis, velocity);
  return (axis == 0 ? end.v_box - end.velocity[0].x() : -end.velocity[0][axis]) / speed;
}

}  // namespace

class SideWalls : public testing::TestWithParam<EngineUnderTest> {
 protected:
  std::unique_ptr<Engine> engine = GetParam().make();
};

TEST_P(SideWalls, FallWithTheSpeedByTheirOwnPower) {
  shakedown::Setup setup = resting_box();
  add_effect(
      setup, "side_wall_restitution",
      {{"restitution", 0.6}, {"law", std::string("power")}, {"exponent", 0.2}, {"reference_speed", 0.5}});
  for (const double speed : {0.25, 0.5, 1.0})
    WITHIN(restitution(*engine, setup, 2, speed), 0.6 * std::pow(speed / 0.5, -0.2), 5e-4, 5e-5) << speed;
  WITHIN(restitution(*engine, setup, 0, 1), 0.76, 3e-4, 2.5e-5);
}

TEST_P(SideWalls, KeepTheirLawBesideAnyOtherLaw) {
  if (engine->can_model(*find_effect("velocity_dependent_restitution")).fidelity == Fidelity::not_modelled)
    return;
  for (const char* other : {"power", "viscoelastic"})
    for (const char* own : {"shared", "constant", "power"}) {
      SCOPED_TRACE(std::string(own) + " beside " + other);
      shakedown::Setup setup = resting_box();
      add_effect(setup, "side_wall_restitution", {{"restitution", 0.6}, {"law", std::string(own)}});
      add_effect(setup, "velocity_dependent_restitution", {{"law", std::string(other)}, {"exponent", 0.3}});
      const ContactLaw law = physics_of(setup).contact;
      const double expected = own == std::string("constant") ? 0.6
                              : own == std::string("power")  ? 0.6 * std::pow(1 / 0.3, -0.12)
                                                             : law.restitution_at(ContactClass::side_wall, 1);
      WITHIN(restitution(*engine, setup, 2, 1), expected, 4e-3, 4.5e-4);
      WITHIN(restitution(*engine, setup, 0, 1), law.restitution_at(ContactClass::end_wall, 1), 3e-3, 2.7e-4);
      const double before = restitution(*engine, setup, 2, 1);
      std::swap(setup.effects[0], setup.effects[1]);
      EXPECT_EQ(restitution(*engine, setup, 2, 1), before);
    }
}

/// Sliding throughout: the wall takes its coefficient times the normal impulse out of the tangential speed.
TEST_P(SideWalls, RubWithTheirOwnCoefficient) {
  if (engine->can_model(*find_effect("side_wall_friction")).fidelity == Fidelity::not_modelled) return;
  shakedown::Setup setup = resting_box();
  setup.box.mass = 1e6;
  add_effect(setup, "side_wall_friction", {{"coefficient", 0.1}});
  const auto taken = [&](int axis) {
    Vec3 velocity(0, 1, 0);
    velocity[axis] = 0.3;
    if (axis != 0) velocity.x() = 1, velocity.y() = 0;
    const State end = met(*engine, setup, axis, velocity);
    return 1 - (axis == 0 ? end.velocity[0].y() : end.velocity[0].x());
  };
  WITHIN(taken(2), 0.1 * 1.76 * 0.3, 2e-5, 1.1e-6);
  EXPECT_EQ(taken(0), 0);
  add_effect(setup, "grain_friction", {{"grain_grain", 0.3}, {"grain_wall", 0.2}});
  WITHIN(taken(2), 0.1 * 1.76 * 0.3, 2e-5, 1.1e-6);
  WITHIN(taken(0), 0.2 * 1.76 * 0.3, 4e-5, 2.1e-6);
}

INSTANTIATE_TEST_SUITE_P(Engines, SideWalls, testing::ValuesIn(engines_under_test()),
                         [](const auto& tested) { return tested.param.name; });
