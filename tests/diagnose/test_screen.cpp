// SPDX-License-Identifier: MIT
// The linear ranking of effects, where the truth is a hard-sphere model with a known strength.
#include <gtest/gtest.h>

#include "effects.hpp"
#include "engines.hpp"
#include "hidden_measurements.hpp"
#include "linear_screen.hpp"
#include "parameter_knobs.hpp"

using namespace shakedown;

namespace {

/// What `candidate` promises for measurements with `hidden` in them, by an engine that the model shares.
ScreenedEffect screened(const std::string& hidden, const std::string& candidate) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const shakedown::Setup setup = believed("4 s");
  const Experiment experiment = measured(
      {hidden.empty() ? std::vector<std::string>{} : std::vector{hidden}, {}, {}, {0.065, 0.104}, 3, "4 s"},
      "hard");
  const std::vector<MeasuredFeatures> features =
      features_of(measurement_of(setup, experiment, all_effects()));
  Workshop workshop;
  workshop.engine = engine.get();
  workshop.known = all_effects();
  workshop.threads = 2;
  const std::vector<Candidate> candidates = candidates_for(setup, {candidate}, all_effects(), *engine);
  const std::vector<ScreenedEffect> list =
      screen(features, free_parameters(setup), candidates, workshop, 256, 1000).list;
  EXPECT_FALSE(list.empty());
  return list.empty() ? ScreenedEffect{} : list.front();
}

TEST(SlowScreen, AnArcIsRankedAtItsOwnLength) {
  const ScreenedEffect strong = screened("blade_arc=blade_length:0.4 m", "blade_arc"),
                       weak = screened("blade_arc=blade_length:1.2 m", "blade_arc"),
                       none = screened("", "blade_arc");
  EXPECT_GT(strong.gain, 10 * weak.gain);  // seen: 1135, 37, 6
  EXPECT_GT(weak.gain, 2 * none.gain);
  EXPECT_NEAR(strong.value, 0.4, 0.1);  // seen: 0.35
  EXPECT_NEAR(weak.value, 1.2, 1.1);    // seen: 1.97, for what it does grows faster than its curvature
}

TEST(SlowScreen, GravityAcrossIsRankedAtItsStrength) {
  const ScreenedEffect strong = screened("constant_acceleration=acceleration.y:0.4 m/s^2",
                                         "constant_acceleration"),
                       weak = screened("constant_acceleration=acceleration.y:0.15 m/s^2",
                                       "constant_acceleration"),
                       none = screened("", "constant_acceleration");
  EXPECT_GT(strong.gain, 1.5 * weak.gain);  // seen: 52, 20, 2
  EXPECT_GT(weak.gain, 3 * none.gain);
  EXPECT_NEAR(strong.value, 0.4, 0.25);  // seen: 0.58
  EXPECT_NEAR(weak.value, 0.15, 0.18);   // seen: 0.27
}

TEST(SlowScreen, AirDragIsRankedAtItsStrength) {
  const ScreenedEffect strong = screened("grain_air_drag=linear:0.004 N s/m", "grain_air_drag"),
                       weak = screened("grain_air_drag=linear:0.001 N s/m", "grain_air_drag"),
                       none = screened("", "grain_air_drag");
  EXPECT_GT(strong.gain, 5 * weak.gain);  // seen: 412.6, 23.3, 0
  EXPECT_GT(weak.gain, 3 * none.gain + 3);
  EXPECT_NEAR(strong.value, 0.004, 0.0025);  // seen: 0.0029
  EXPECT_NEAR(weak.value, 0.001, 0.0008);    // seen: 0.0007
}

TEST(SlowScreen, AReleaseWithVelocityIsRankedAtItsStrength) {
  const ScreenedEffect found = screened("initial_box_velocity=velocity:10 mm/s", "initial_box_velocity");
  EXPECT_GT(found.gain, 300);             // seen: 1104
  EXPECT_NEAR(found.value, 0.01, 0.003);  // seen: 0.0003
}

}  // namespace
