// SPDX-License-Identifier: MIT
// A coefficient of friction that depends on the slip: each engine takes that of the slip at first touch.
#include <gtest/gtest.h>

#include <cmath>

#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double falling(double slip) { return 0.4 - 0.25 * slip; }

/// Speed along the surface that a grain leaves at the wall across `axis` of a heavy box, which it meets at
/// `slip` along and 50 mm/s across: it slides throughout.
double taken_at(const Engine& engine, int axis, double slip) {
  shakedown::Setup setup;
  setup.release.displacement = 0;
  setup.spring.frequency = 1e-6;
  setup.box.mass = 1e6;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.1;
  setup.soft.steps_per_contact = 100;
  setup.run.duration = 4e-3;
  setup.run.sample_rate = 250;
  add_effect(setup, "user_friction", {{"friction", std::string("0.4-0.25*v")}});
  const int along = (axis + 1) % 3;
  Vec3 velocity = Vec3::Zero(), place = Vec3::Zero();
  velocity[axis] = 0.05, velocity[along] = slip;
  place[axis] = 0.05 - 0.005 - 0.001 * 0.05;
  const Trajectory run = run_with(engine, setup, {{place, velocity}});
  return slip - run.end_state.velocity[0][along];
}

}  // namespace

class FrictionLaw : public testing::TestWithParam<EngineUnderTest> {
 protected:
  std::unique_ptr<Engine> engine = GetParam().make();
};

TEST_P(FrictionLaw, TakesTheCoefficientOfTheSlipAtFirstTouch) {
  for (const int axis : {0, 1, 2})
    for (const double slip : {0.4, 0.8, 1.4})
      WITHIN(taken_at(*engine, axis, slip), falling(slip) * 1.76 * 0.05, 2e-6, 1.1e-7) << axis << " " << slip;
}

INSTANTIATE_TEST_SUITE_P(Engines, FrictionLaw, testing::ValuesIn(engines_that_model("user_friction")),
                         [](const auto& tested) { return tested.param.name; });
