// SPDX-License-Identifier: MIT
// Noise of what was really recorded: found against true.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "audit.hpp"
#include "recorded_swing.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

struct NoiseCase {
  std::string name;
  Recorder how;
  Tolerance within{0.1, 0.08};  ///< of the true noise
};

std::vector<NoiseCase> noise_cases() {
  std::vector<NoiseCase> cases;
  for (const double rate : {15.0, 20.0, 30.0, 60.0, 120.0, 250.0, 500.0, 1000.0}) {
    const std::string at = std::to_string(static_cast<int>(rate)) + " Hz";
    cases.push_back({"white " + at, {.rate = rate}});
    cases.push_back({"small " + at, {.rate = rate, .white = 5e-5}});
    // Errors of rounding follow the speed, so that they are not quite white.
    cases.push_back({"rounded " + at, {.rate = rate, .white = 1e-5, .step = 5e-4}, {0.12, 0.097}});
    cases.push_back(
        {"jittering clock, known " + at, {.rate = rate, .jitter = 0.05 / rate, .jitter_known = true}});
    cases.push_back({"jittering clock, unknown " + at, {.rate = rate, .jitter = 2e-4}});
  }
  for (const double rate : {60.0, 250.0, 500.0, 1000.0}) {
    const std::string at = std::to_string(static_cast<int>(rate)) + " Hz";
    cases.push_back({"at rest for three quarters " + at, {.rate = rate, .duration = 40, .stops_after = 10}});
    cases.push_back({"rounded, at rest for three quarters " + at,
                     {.rate = rate, .duration = 40, .white = 1e-5, .step = 5e-4, .stops_after = 10},
                     {0.14, 0.05}});
  }
  for (const double rate : {250.0, 500.0, 1000.0})
    cases.push_back(
        {"correlated " + std::to_string(static_cast<int>(rate)) + " Hz", {.rate = rate, .colour = 0.4}});
  return cases;
}

TEST(SlowNoise, IsFoundWhateverTheCamera) {
  for (const NoiseCase& one : noise_cases()) {
    const RecordedSwing swing = recorded_swing(one.how);
    const RunAudit audit = audit_run(swing.run);
    const double ratio = audit.box.standard_deviation / swing.noise;
    std::printf("%-45s true %.4f mm, found over true %.3f, order %d\n", one.name.c_str(), swing.noise * 1e3,
                ratio, audit.box.order);
    WITHIN(ratio, 1, one.within) << one.name;
    EXPECT_EQ(audit.box.source, NoiseSource::frames) << one.name;
    EXPECT_LE(audit.box.outliers, 0.03 * static_cast<double>(swing.run.time.size())) << one.name;
  }
}

TEST(Noise, OfAnEncoderThatRestsIsAtLeastThatOfRounding) {
  constexpr double step = 1.57e-5;
  const RunAudit audit =
      audit_run(recorded_swing({.duration = 60, .white = 0, .step = step, .stops_after = 8}).run);
  WITHIN(audit.box.quantum / step, 1, 2e-11, 1e-12);  // rounding of 0.1 m
  EXPECT_GE(audit.box.standard_deviation, 0.99 * step / std::sqrt(12.0));
  EXPECT_LE(audit.box.standard_deviation, 1.2 * step / std::sqrt(12.0));
  EXPECT_EQ(audit.box.outliers, 0);
}

TEST(Noise, ThatFramesCannotTellIsTheDeclaredOneAndIsSaid) {
  RecordedSwing swing = recorded_swing({.rate = 4});
  swing.run.box_uncertainty = 3e-4;
  const RunAudit declared = audit_run(swing.run);
  EXPECT_EQ(declared.box.source, NoiseSource::declared);
  EXPECT_DOUBLE_EQ(declared.box.standard_deviation, 3e-4);
  ASSERT_FALSE(warnings_of(declared).empty());
  EXPECT_NE(warnings_of(declared).front().find("uncertainty"), std::string::npos);
  swing.run.box_uncertainty = std::numeric_limits<double>::quiet_NaN();
  const RunAudit without = audit_run(swing.run);
  EXPECT_NE(without.box.source, NoiseSource::frames);
  EXPECT_FALSE(warnings_of(without).empty());
}

TEST(Noise, AStatedUncertaintyAboveWhatFramesScatterByIsTaken) {
  RecordedSwing swing = recorded_swing({});
  swing.run.box_uncertainty = 5 * swing.noise;
  const RunAudit stated = audit_run(swing.run);
  EXPECT_DOUBLE_EQ(stated.box.standard_deviation, 5 * swing.noise);
  EXPECT_EQ(stated.box.source, NoiseSource::declared);
}

// 40 s at rest hold some hundred times the memory: its size is known to a tenth, the memory to a third.
TEST(Noise, WanderIsFoundAtRest) {
  double size = 0, memory = 0;
  constexpr int repeats = 6;
  for (std::uint64_t seed = 1; seed <= repeats; ++seed) {
    const RunAudit audit = audit_run(
        recorded_swing({.rate = 120, .duration = 50, .wander = 3e-4, .memory = 0.4, .stops_after = 10}, seed)
            .run);
    size += audit.box.wander / repeats, memory += audit.box.wander_time / repeats;
  }
  std::printf("wander %.4f mm of 0.3, memory %.3f s of 0.4\n", size * 1e3, memory);
  WITHIN(size / 3e-4, 1, 0.1, 0.052);
  WITHIN(memory / 0.4, 1, 0.8, 0.61);
}

TEST(Noise, WanderIsNotSeenWhereThereIsNoneAndUntoldWithoutRest) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    seen += audit_run(recorded_swing({.rate = 120, .stops_after = 10}, seed).run).box.wander != 0;
  EXPECT_LE(seen, 1);
  EXPECT_TRUE(std::isnan(audit_run(recorded_swing({.duration = 8}).run).box.wander));
}

TEST(Noise, OverTimeIsToldInRows) {
  RecordedSwing swing = recorded_swing({.duration = 12});
  Random random(5, 0, Stream::other);
  for (std::size_t i = 0; i < swing.run.time.size(); ++i)
    if (swing.run.time[i] < 6) swing.run.x_box[i] += 4e-4 * random.normal();
  const std::vector<NoiseAt> rows = audit_run(swing.run).box.over_time;
  ASSERT_GE(rows.size(), 8u);
  WITHIN(rows.front().deviation, std::hypot(2e-4, 4e-4), 6e-5, 2e-5);
  WITHIN(rows.back().deviation, 2e-4, 3e-5, 2.1e-5);
}

TEST(Release, IsFoundAfterALeadIn) {
  for (const double rate : {30.0, 120.0, 500.0})
    for (const double lead_in : {0.3, 1.0}) {
      const RunAudit audit = audit_run(recorded_swing({.rate = rate, .lead_in = lead_in}).run);
      const ReleaseFound& release = audit.release;
      const double frames = std::min(rate, 250.0);  // a second
      WITHIN((release.start - lead_in) * frames, 0, 2.5, 2) << rate;
      WITHIN((release.lead_in - lead_in) * frames, 0, 2.5, 2) << rate;
      WITHIN(release.displacement, 0.1075, 3e-4, 9.1e-5) << rate;
      WITHIN(release.centre, 0, 5e-4, 3.9e-5) << rate;
    }
}

TEST(Release, OfARecordThatBeginsInTheMotionIsItsFirstFrame) {
  for (const double from : {0.0, 0.1, 0.38, 0.6}) {
    RecordedSwing swing = recorded_swing({});
    MeasuredRun& run = swing.run;
    const auto first = static_cast<std::ptrdiff_t>(from * run.frame_rate);
    run.time.erase(run.time.begin(), run.time.begin() + first);
    run.x_box.erase(run.x_box.begin(), run.x_box.begin() + first);
    const RunAudit audit = audit_run(run);
    EXPECT_EQ(audit.release.lead_in, 0) << from;
    EXPECT_DOUBLE_EQ(audit.release.start, run.time.front()) << from;
    WITHIN(audit.release.displacement, shakedown::swing(run.time.front()), 1e-3, 2e-4) << from;
    const double speed =
        (shakedown::swing(run.time.front() + 1e-4) - shakedown::swing(run.time.front())) / 1e-4;
    WITHIN(audit.release.velocity, speed, 0.06, 0.014) << from;
  }
}

TEST(Release, RestIsWhereTheBoxEnds) {
  const RunAudit audit = audit_run(recorded_swing({.duration = 30}).run);
  WITHIN(audit.release.rest, 0, 7e-5, 3.5e-6);
  EXPECT_TRUE(std::isnan(audit_run(recorded_swing({.duration = 8}).run).release.rest));
}

TEST(Audit, IsFiniteWhateverTheTable) {
  const auto check = [](const MeasuredRun& run) {
    const RunAudit audit = audit_run(run);
    EXPECT_TRUE(std::isfinite(audit.box.standard_deviation));
    EXPECT_GT(audit.box.standard_deviation, 0);
    for (const double correlation : audit.box.correlation) EXPECT_TRUE(std::isfinite(correlation));
    for (const NoiseAt& row : audit.box.over_time) EXPECT_TRUE(std::isfinite(row.deviation));
  };
  constexpr double missing = std::numeric_limits<double>::quiet_NaN();
  MeasuredRun run = recorded_swing({.rate = 50, .duration = 4}).run;
  std::vector<MeasuredRun> tables(6, run);
  for (double& x : tables[0].x_box) x = missing;
  for (double& x : tables[1].x_box) x = 0.05;
  tables[2].time.resize(2), tables[2].x_box.resize(2);
  tables[3].time.resize(6), tables[3].x_box.resize(6);
  for (std::size_t i = 0; i < run.time.size(); i += 2) tables[4].x_box[i] = missing;
  for (double& x : tables[5].x_box) x = std::round(x / 0.05) * 0.05;
  for (const MeasuredRun& table : tables) check(table);
}

}  // namespace
}  // namespace shakedown
