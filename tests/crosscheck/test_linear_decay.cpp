// SPDX-License-Identifier: MIT
#include "linear_decay.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "decay_baselines.hpp"
#include "engines.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

DecayMeasurement measurement(double slope, double curvature) {
  return {"hard", 0.065, 1, {0.2, 0.02, 16}, {slope, 1e-4, 16}, {curvature, 2e-4, 16}, {0.3, 0.02, 16}};
}

std::filesystem::path fresh_file(const std::string& name) {
  const auto file = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove(file);
  return file;
}

}  // namespace

TEST(LinearDecay, WhatMadeABaselinePassesAgainstIt) {
  const DecayMeasurement measured = measurement(-0.018, 6e-4);
  const DecayBaseline baseline = baseline_of(measured, "1", "abc");
  for (const DecayCheck& check : checks_of(measured, &baseline)) EXPECT_TRUE(check.passed) << check.name;
}

TEST(LinearDecay, AnotherSlopeOrCurvatureFails) {
  const DecayBaseline baseline = baseline_of(measurement(-0.018, 6e-4), "1", "abc");
  EXPECT_FALSE(checks_of(measurement(-0.019, 6e-4), &baseline)[1].passed);
  EXPECT_FALSE(checks_of(measurement(-0.018, 2e-3), &baseline)[2].passed);
}

TEST(LinearDecay, AnExponentialDecayFails) {
  DecayMeasurement measured = measurement(-0.018, 6e-4);
  const DecayBaseline baseline = baseline_of(measured, "1", "abc");
  measured.rms_ratio.mean = 2;
  EXPECT_FALSE(checks_of(measured, &baseline)[0].passed);
}

TEST(LinearDecay, WithoutABaselineSlopeAndCurvatureFail) {
  const std::vector<DecayCheck> checks = checks_of(measurement(-0.018, 6e-4), nullptr);
  EXPECT_TRUE(checks[0].passed);
  EXPECT_FALSE(checks[1].passed || checks[2].passed);
  EXPECT_NE(checks[1].remark.find("--update"), std::string::npos);
}

TEST(LinearDecay, ACurvatureIsStated) {
  const DecayBaseline baseline = baseline_of(measurement(-0.018, 6e-4), "1", "abc");
  EXPECT_NE(checks_of(measurement(-0.018, 6e-4), &baseline)[2].remark.find("slows down"), std::string::npos);
  EXPECT_NE(checks_of(measurement(-0.018, 1e-5), &baseline)[2].remark.find("no curvature"),
            std::string::npos);
}

TEST(LinearDecay, BaselinesReadBackAsWritten) {
  const auto file = fresh_file("baselines_round_trip.json");
  const DecayBaseline baseline = baseline_of(measurement(-0.018, 6e-4), "0.1.0", "abc");
  write_decay_baselines(file, {baseline});
  const std::vector<DecayBaseline> read = read_decay_baselines(file);
  const DecayBaseline* found = find_baseline(read, "hard", 0.065);
  ASSERT_NE(found, nullptr);
  WITHIN(found->slope.low, baseline.slope.low, 1e-12, 2.5e-13);
  WITHIN(found->curvature.high, baseline.curvature.high, 1e-12, 4.9e-13);
  WITHIN(found->slope_found.mean, -0.018, 8e-17, 4e-18);
  EXPECT_EQ(found->slope_found.n, 16);
  EXPECT_EQ(found->version, "0.1.0");
  EXPECT_EQ(find_baseline(read, "soft", 0.065), nullptr);
  const auto again = fresh_file("baselines_round_trip_again.json");
  write_decay_baselines(again, read);
  EXPECT_EQ(read_decay_baselines(again).size(), 1u);
}

TEST(LinearDecay, AnUpdateKeepsTheOthers) {
  const DecayBaseline old = baseline_of(measurement(-0.018, 6e-4), "1", "a");
  DecayBaseline other = old, fresh = old;
  other.engine = "soft";
  fresh.version = "2";
  const std::vector<DecayBaseline> all = updated({other, old}, {fresh});
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].engine, "hard");
  EXPECT_EQ(all[0].version, "2");
  EXPECT_EQ(all[1].version, "1");
}

TEST(LinearDecay, BadBaselinesAreTheUsersInput) {
  const auto file = fresh_file("no_baselines.json");
  EXPECT_THROW(read_decay_baselines(file), FileError);
  std::ofstream(file) << "{\"baselines\": [{}]}";
  EXPECT_THROW(read_decay_baselines(file), InputError);
}

// An ensemble of the engine itself against the intervals in the repository.
TEST(SlowLinearDecay, TheHardEngineKeepsItsBaselines) {
  const std::vector<DecayBaseline> baselines = read_decay_baselines(default_decay_baselines());
  for (const double length : {0.040, 0.065, 0.085, 0.104}) {
    EnsembleOptions options;
    options.runs = 16;
    const DecayMeasurement measured = measure_decay(*engine_named("hard"), length, 2, options);
    const std::vector<DecayCheck> checks = checks_of(measured, find_baseline(baselines, "hard", length));
    EXPECT_TRUE(checks[1].passed) << readable(checks[1]);
    EXPECT_TRUE(checks[2].passed) << readable(checks[2]);
  }
}
