// SPDX-License-Identifier: MIT
// A run rebuilt from its collision log is the run, bit for bit: at every sample, with every effect, for few
// grains and for many.
#include "replay.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "effects.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

shakedown::Setup setup_with(const std::string& effects, const std::string& rest = "") {
  return parse_setup("[run]\nduration = \"4 s\"\nsample_rate = \"100 Hz\"\n" + rest + effects, "test.toml",
                     all_effects());
}

Trajectory logged(const shakedown::Setup& setup, int run = 0) {
  RunOptions options;
  options.run = run;
  options.log_collisions = true;
  return make_hard_engine()->run(setup, options);
}

void expect_same_state(const State& a, const State& b) {
  EXPECT_EQ(a.x_box, b.x_box);
  EXPECT_EQ(a.v_box, b.v_box);
  ASSERT_EQ(a.spin.size(), b.spin.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a.position[i], b.position[i]) << "grain " << i;
    EXPECT_EQ(a.velocity[i], b.velocity[i]) << "grain " << i;
  }
  for (std::size_t i = 0; i < a.spin.size(); ++i) EXPECT_EQ(a.spin[i], b.spin[i]) << "grain " << i;
}

struct Case {
  const char* name;
  std::string text;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class ReplayOf : public ::testing::TestWithParam<Case> {};

}  // namespace

TEST_P(ReplayOf, IsTheRunBitForBit) {
  const shakedown::Setup setup = setup_with(GetParam().text);
  const Trajectory run = logged(setup, 3);
  ASSERT_NE(run.collision_log, nullptr);
  const CollisionLog& log = *run.collision_log;
  Replay replay(setup, log);
  for (std::size_t k = 0; k < run.time.size(); ++k) {
    replay.advance_to(run.time[k]);
    const State state = replay.state();
    ASSERT_EQ(state.x_box, run.x_box[k]) << "t = " << run.time[k];
    ASSERT_EQ(state.v_box, run.v_box[k]) << "t = " << run.time[k];
  }
  replay.advance_to(run.end_time);
  EXPECT_FALSE(replay.step());
  expect_same_state(replay.state(), run.end_state);
  std::printf("%s: %lld collisions, %.2f entries and %.2f bytes a collision\n", GetParam().name,
              static_cast<long long>(log.impacts),
              static_cast<double>(log.entries) / static_cast<double>(log.impacts),
              static_cast<double>(log.events.size()) / static_cast<double>(log.impacts));
}

TEST_P(ReplayOf, SavesNothingOnTheRunItself) {
  const shakedown::Setup setup = setup_with(GetParam().text);
  RunOptions options;
  options.run = 3;
  expect_same_state(make_hard_engine()->run(setup, options).end_state, logged(setup, 3).end_state);
}

const std::string friction = "[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\ngrain_wall = 0.1\n";
INSTANTIATE_TEST_SUITE_P(
    Effects, ReplayOf,
    ::testing::Values(
        Case{"plain", ""}, Case{"friction", friction},
        Case{"falling",
             "[[effect]]\nname = \"constant_acceleration\"\nacceleration = [\"0.05 m/s^2\", \"0 m/s^2\", "
             "\"-0.1 m/s^2\"]\n"},
        Case{"arc", "[[effect]]\nname = \"blade_arc\"\n"},
        Case{"air", "[[effect]]\nname = \"grain_air_drag\"\nlinear = \"2e-4 N s/m\"\n"},
        Case{"dry", "[[effect]]\nname = \"clamp_dry_friction\"\nforce = \"0.02 N\"\n"},
        Case{"cohesion", "[[effect]]\nname = \"grain_cohesion\"\nforce = \"0.02 N\"\nrange = \"0.02 mm\"\n"},
        Case{"cubic", "[[effect]]\nname = \"spring_cubic\"\ncoefficient = 0.1\n"},
        Case{"velocity", "[[effect]]\nname = \"velocity_dependent_restitution\"\nlaw = \"viscoelastic\"\n"},
        Case{"shaken", "[[effect]]\nname = \"oscillating_acceleration\"\namplitude = {x = \"0.1 m/s^2\"}\n"},
        Case{"arc_and_kick",
             "[[effect]]\nname = \"blade_arc\"\n[[effect]]\nname = \"initial_box_velocity\"\nvelocity = \"50 "
             "mm/s\"\n"}),
    [](const auto& of) { return std::string(of.param.name); });

TEST(SlowReplay, OfManyGrainsToo) {
  shakedown::Setup setup = setup_with("");
  setup.grains.count = 1000;
  setup.box.mass *= 1000 / 37.0;
  setup.box.width = {0.26, 0.26};
  setup.run.duration = 0.3;
  const Trajectory run = logged(setup);
  Replay replay(setup, *run.collision_log);
  replay.advance_to(run.end_time);
  expect_same_state(replay.state(), run.end_state);
}

TEST(Replay, RefusesALogOfAnotherSetup) {
  shakedown::Setup setup = setup_with("");
  const Trajectory run = logged(setup);
  setup.restitution.grain_grain = 0.76;
  Replay replay(setup, *run.collision_log);
  EXPECT_THROW(replay.advance_to(run.end_time), FileError);
}

TEST(Replay, RefusesALogCutShort) {
  const shakedown::Setup setup = setup_with("");
  CollisionLog log = *logged(setup).collision_log;
  log.events.resize(log.events.size() / 2);
  Replay replay(setup, log);
  EXPECT_THROW(replay.advance_to(log.end_time), FileError);
}
