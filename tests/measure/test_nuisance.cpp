// SPDX-License-Identifier: MIT
// What is known beforehand, as each run has it.
#include "nuisance.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "effects.hpp"
#include "known_setup.hpp"
#include "setup_file.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

MeasuredRun run_named(const std::string& name, bool empty) {
  MeasuredRun run;
  run.name = name;
  if (empty) run.overrides.push_back({"grains.count", "0", "test"});
  for (int i = 0; i < 100; ++i) {
    run.time.push_back(0.01 * i);
    run.x_box.push_back(0.1);
    if (!empty) run.x_com.push_back(0.1);
  }
  return run;
}

Measurement measured(std::vector<KnownValue> known, std::vector<MeasuredRun> runs) {
  Experiment experiment;
  experiment.known = std::move(known);
  experiment.runs = std::move(runs);
  return measurement_of(shakedown::Setup{}, experiment, all_effects());
}

const CameraNuisance* camera_of(const std::vector<CameraNuisance>& list, std::string_view known_as) {
  for (const CameraNuisance& one : list)
    if (one.known_as == known_as) return &one;
  return nullptr;
}

TEST(Nuisance, TheValueCountsAndNotOnlyItsError) {
  const Measurement m = measured({{"box.mass", 0.45, 0.002, {}}, {"camera.shutter", 1.4e-3, 2e-4, {}}},
                                 {run_named("a", false)});
  EXPECT_DOUBLE_EQ(m.runs[0].setup.box.mass, 0.45);
  const CameraNuisance* shutter = camera_of(camera_nuisances(m, all_effects()), "camera.shutter");
  const std::vector<CameraNuisance> list = camera_nuisances(m, all_effects());
  shutter = camera_of(list, "camera.shutter");
  ASSERT_NE(shutter, nullptr);
  EXPECT_DOUBLE_EQ(get_number(m.runs[0].setup, shutter->key, all_effects()), 1.4e-3);
  EXPECT_DOUBLE_EQ(shutter->deviation(), 2e-4);
}

TEST(Nuisance, ARunsOwnValueIsOfThatRunAlone) {
  MeasuredRun own = run_named("b", false);
  own.known = {{"box.mass", 0.5, 0.001, {}}, {"camera.scale", 0, 0.02, {}}};
  const Measurement m = measured({{"box.mass", 0.434, 0.002, {}}}, {run_named("a", false), own});
  EXPECT_DOUBLE_EQ(m.runs[0].setup.box.mass, 0.434);
  EXPECT_DOUBLE_EQ(m.runs[1].setup.box.mass, 0.5);
  const std::vector<CameraNuisance> cameras = camera_nuisances(m, all_effects());
  const CameraNuisance* scale = camera_of(cameras, "camera.scale");
  ASSERT_NE(scale, nullptr);
  EXPECT_TRUE(scale->each_run);
  EXPECT_DOUBLE_EQ(scale->deviation_of[0], 0.005);
  EXPECT_DOUBLE_EQ(scale->deviation_of[1], 0.02);
  std::vector<WeighedNuisance> weights = weighed_nuisances(m);
  std::erase_if(weights, [](const WeighedNuisance& w) { return w.key != "box.mass"; });
  ASSERT_EQ(weights.size(), 2u);
  for (const WeighedNuisance& weight : weights)
    EXPECT_DOUBLE_EQ(weight.deviation, weight.of_one_run ? 0.001 : 0.002);
}

TEST(Nuisance, AnErrorOfZeroFixes) {
  const Measurement m =
      measured({{"box.mass", 0.434, 0, {}}, {"camera.scale", 0, 0, {}}}, {run_named("a", false)});
  EXPECT_EQ(camera_of(camera_nuisances(m, all_effects()), "camera.scale"), nullptr);
  for (const WeighedNuisance& weight : weighed_nuisances(m)) EXPECT_NE(weight.key, "box.mass");
  EXPECT_EQ(exactly_known(m, all_effects()), std::vector<std::string>{"camera_scale"});
}

TEST(Nuisance, AnUnknownOriginIsOfTheRunThatStartsAnywhere) {
  const Measurement m = measured({}, {run_named("empty", true), run_named("a", false)});
  const std::vector<CameraNuisance> cameras = camera_nuisances(m, all_effects());
  const CameraNuisance* origin = camera_of(cameras, "camera.origin");
  ASSERT_NE(origin, nullptr);
  EXPECT_GT(origin->deviation_of[0], 0.05);
  EXPECT_LT(origin->deviation_of[1], 1e-3);
  // Weights are found though the first run has no grains.
  EXPECT_EQ(weighed_nuisances(m).size(), 2u);
}

TEST(Nuisance, TheFrequencyIsAsUncertainAsTheClock) {
  const Measurement m =
      measured({{"spring.frequency", 1.25, 0.003, {}}, {"clock", 0, 0.0032, {}}}, {run_named("a", false)});
  const auto known = known_frequency(m);
  ASSERT_TRUE(known.has_value());
  EXPECT_DOUBLE_EQ(known->value, 1.25);
  WITHIN(known->error, 0.005, 2e-17, 1.2e-18);
  EXPECT_FALSE(known_frequency(measured({}, {run_named("a", false)})).has_value());
}

}  // namespace
}  // namespace shakedown
