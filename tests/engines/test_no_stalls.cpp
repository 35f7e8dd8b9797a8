// SPDX-License-Identifier: MIT
// Event-driven engines stall where grains are pressed together: infinitely many impacts in a finite time, or
// a bed at rest that hops for ever. Strong settings of every effect, 32 seeds each through the whole 22 s,
// with a bound on the impacts of a run.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>

#include "setups.hpp"

using namespace shakedown;

namespace {

struct Strong {
  std::string name, effect;
  std::map<std::string, ParameterValue> values;
  double box_width = 0.05;  // m
};
void PrintTo(const Strong& strong, std::ostream* out) { *out << strong.name; }

constexpr double twentieth_of_g = 0.05 * 9.80665;

std::vector<Strong> strong_settings() {
  return {{"friction", "grain_friction", {{"grain_grain", 0.5}, {"grain_wall", 0.5}}},
          {"cohesion", "grain_cohesion", {{"force", 0.05}, {"range", 1e-4}}},
          {"short_cohesion", "grain_cohesion", {{"force", 0.05}, {"range", 2e-5}}},
          {"clump", "grain_cohesion", {{"force", 0.3}, {"range", 2e-4}, {"walls", 0.0}}},
          // Five grains fill the paper's 50 mm from wall to wall (hardsphere/README.md).
          {"glue", "grain_cohesion", {{"force", 0.2}, {"range", 2e-5}}, 0.051},
          {"slow_impacts_elastic", "velocity_dependent_restitution", {{"exponent", 0.5}}},
          {"viscoelastic", "velocity_dependent_restitution", {{"law", std::string("viscoelastic")}}},
          {"dead_side_walls", "side_wall_restitution", {{"restitution", 0.1}}},
          {"viscous", "blade_viscous_damping", {{"damping", 0.5}}},
          {"quadratic", "blade_quadratic_drag", {{"drag", 0.5}}},
          {"hard_spring", "spring_cubic", {{"coefficient", 0.5}}},
          {"soft_spring", "spring_cubic", {{"coefficient", -0.3}}},
          {"heavy", "blade_mass", {{"mass", 0.4}}},
          {"thrown", "initial_box_velocity", {{"velocity", 1.0}}},
          {"square", "initial_packing", {{"packing", std::string("square")}}},
          {"spread", "initial_packing", {{"packing", std::string("spread")}}},
          {"shaken", "oscillating_acceleration", {{"amplitude", Vec3(0.5, 0.5, 0.5)}, {"frequency", 3.0}}},
          {"thick_air", "grain_air_drag", {{"linear", 0.01}, {"quadratic", 0.01}}},
          {"short_blade", "blade_arc", {{"blade_length", 0.3}}},
          {"formula", "user_force", {{"force", std::string("-0.4*v*exp(-((x-0.045)/0.012)^2)")}}},
          {"clamp", "clamp_dry_friction", {{"force", 0.1}}},
          {"gravity_along", "constant_acceleration", {{"acceleration", Vec3(-twentieth_of_g, 0, 0)}}},
          {"gravity_across", "constant_acceleration", {{"acceleration", Vec3(0, 0, -twentieth_of_g)}}},
          {"tenth_of_gravity_along", "constant_acceleration", {{"acceleration", Vec3(-1, 0, 0)}}}};
}

class SlowStalls : public testing::TestWithParam<Strong> {
 protected:
  shakedown::Setup setup() const {
    shakedown::Setup setup;
    setup.run.duration = 22;
    setup.run.sample_rate = 50;
    setup.box.width = {GetParam().box_width, GetParam().box_width};
    add_effect(setup, GetParam().effect, GetParam().values);
    return setup;
  }
  static bool exact() {
    const EffectRecord* record = find_effect(GetParam().effect);
    return record->capability("hard").fidelity == Fidelity::exact;
  }
};

TEST_P(SlowStalls, NoneOf32Seeds) {
  const auto engine = make_hard_engine();
  double worst_time = 0;
  std::int64_t most_events = 0, most_impacts = 0;
  for (int run = 0; run < 32; ++run) {
    SCOPED_TRACE(run);
    RunOptions options;
    options.run = run;
    const std::clock_t start = std::clock();
    const Trajectory result = engine->run(setup(), options);
    worst_time = std::max(worst_time, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    most_events = std::max(most_events, result.events);
    most_impacts = std::max(most_impacts, result.collisions[0] + result.collisions[1] + result.collisions[2]);
    EXPECT_DOUBLE_EQ(result.end_time, 22);
    // most seen: 1.1e-12, under a tenth of gravity, whose frame is 242 m away at the end
    EXPECT_LE(result.health.ledger_error, exact() ? 3e-12 : 1e-10);
    EXPECT_LE(result.health.momentum_error, exact() ? 1e-12 : 1e-10);
    EXPECT_LE(result.health.deepest_overlap, 1e-12);
  }
  std::printf("%s: at most %.3g impacts, %.3g events, %.2f CPU s a run\n", GetParam().name.c_str(),
              static_cast<double>(most_impacts), static_cast<double>(most_events), worst_time);
  // most seen: 2.0 million, a tenth of gravity along; a stall makes as many in a second and does not
  // end
  EXPECT_LE(most_impacts, 6'000'000);
  EXPECT_LE(worst_time, 10);
}

INSTANTIATE_TEST_SUITE_P(Strong, SlowStalls, testing::ValuesIn(strong_settings()),
                         [](const auto& strong) { return strong.param.name; });

/// Rows of unequal grains wedged between the side walls: rare, so many short runs.
TEST(SlowStallsOfUnequalGrains, NoneOf400Runs) {
  shakedown::Setup setup;
  setup.run.duration = 3;
  setup.run.sample_rate = 50;
  add_effect(setup, "grain_polydispersity", {{"relative_deviation", 0.05}});
  const auto engine = make_hard_engine();
  for (int run = 0; run < 400; ++run) {
    SCOPED_TRACE(run);
    RunOptions options;
    options.run = run;
    ASSERT_NO_THROW(engine->run(setup, options));
  }
}

/// A row of five just fits between the side walls, and friction takes what pushes it apart: without the 10 us
/// in which grains that touch again do not rub this run made 22 million impacts.
TEST(StallsOfFriction, NoneOfARowThatRubsBetweenTheSideWalls) {
  shakedown::Setup setup;
  setup.run.duration = 20;
  setup.run.seed = 146449;
  setup.release.packing = Packing::square;
  setup.restitution = {0.8, 0.737};
  setup.hard.pair_elastic_speed = 0.01;
  add_effect(setup, "grain_friction", {{"grain_grain", 0.131}, {"grain_wall", 0.131}});
  RunOptions options;
  options.run = 30;
  const Trajectory run = make_hard_engine()->run(setup, options);
  EXPECT_LT(run.collisions[0] + run.collisions[1] + run.collisions[2],
            2'000'000);  // most of 40 such runs: 0.42 million
}

}  // namespace
