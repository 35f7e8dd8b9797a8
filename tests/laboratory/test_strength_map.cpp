// SPDX-License-Identifier: MIT
// The map of smallest strengths: where it is known what must come out.
#include "strength_map.hpp"

#include <gtest/gtest.h>

#include "effects.hpp"
#include "engines.hpp"
#include "measurements.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

Measurement planned(const Setup& setup, const std::vector<double>& lengths, const Engine& engine) {
  RecordingSettings camera;
  camera.frame_rate = 100;
  Experiment experiment =
      make_measurements(setup, runs_of_lengths(lengths), camera, {&engine, all_effects(), 3, 2, nullptr});
  experiment.known = usually_known(setup, camera);
  return measurement_of(setup, experiment, all_effects());
}

MapLine line(double noise, double runs = 1, double restitution_error = 0, double wander = 0) {
  MapLine one{"tried", ""};
  one.noise = noise, one.runs = runs, one.restitution_error = restitution_error, one.wander = wander;
  return one;
}

}  // namespace

TEST(StrengthMap, RefusesBoxesAlone) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  shakedown::Setup setup;
  setup.grains.count = 0, setup.run.duration = 2;
  MapOptions options;
  options.known = all_effects();
  EXPECT_THROW(strength_map(setup, planned(setup, {0.04}, *engine), *engine, {line(1)}, options), InputError);
}

// Damping of the box, which is linear in its strength and which nothing else imitates, against cameras; and a
// law of the restitution, against what is known of the restitutions.
TEST(SlowStrengthMap, WorseCamerasSeeLessAndKnownRestitutionsTellLaws) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  shakedown::Setup setup;
  setup.run.duration = 5;
  MapOptions options;
  options.known = all_effects();
  options.effects = {"blade_viscous_damping", "velocity_dependent_restitution"};
  options.execution.threads = 2;
  const StrengthMap map =
      strength_map(setup, planned(setup, {0.04, 0.065}, *engine), *engine,
                   {line(1), line(4), line(20), line(1, 4), line(1, 1, 0.003), line(1, 1, 0, 1e-3)}, options);
  ASSERT_EQ(map.effects.size(), 2u);
  EXPECT_TRUE(map.left_out.empty());
  const std::vector<double>&damping = map.effects[0].smallest, &law = map.effects[1].smallest;
  for (const MappedEffect& effect : map.effects) {
    std::printf("%-50s", effect.key.c_str());
    for (const double one : effect.smallest) std::printf(" %10.4g", one);
    std::printf("\n");
  }
  EXPECT_GT(damping[1], damping[0]);
  EXPECT_GT(damping[2], 2 * damping[1]);  // where noise is all, it goes with it
  EXPECT_LT(damping[3], damping[0]);
  EXPECT_GT(damping[5], damping[0]);
  EXPECT_LT(law[4], law[0]);
}

TEST(SlowStrengthMap, WhatThereIsNoTimeForIsNamed) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  shakedown::Setup setup;
  setup.run.duration = 1;
  MapOptions options;
  options.known = all_effects();
  options.seconds = 1e-6;
  options.execution.threads = 2;
  const StrengthMap map = strength_map(setup, planned(setup, {0.04}, *engine), *engine, {line(1)}, options);
  EXPECT_TRUE(map.effects.empty());
  EXPECT_GT(map.left_out.size(), 10u);
  EXPECT_NE(map.left_out[0].reason.find("time"), std::string::npos);
}
