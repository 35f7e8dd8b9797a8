// SPDX-License-Identifier: MIT
// Frames that are no numbers, in every place of a record: what the audit finds stays finite.
#include <gtest/gtest.h>

#include <cmath>

#include "audit.hpp"

using namespace shakedown;

namespace {

MeasuredRun swing(std::size_t frames) {
  MeasuredRun run;
  run.name = "swing";
  run.frame_rate = 250;
  for (std::size_t i = 0; i < frames; ++i) {
    const double t = static_cast<double>(i) / 250;
    run.time.push_back(t);
    run.x_box.push_back(0.1 * std::cos(7.7 * t) + 1e-4 * std::sin(1e4 * static_cast<double>(i * i)));
  }
  return run;
}

void expect_finite(const MeasuredRun& run, const std::string& what) {
  const RunAudit audit = audit_run(run);
  EXPECT_TRUE(std::isfinite(audit.box.standard_deviation)) << what;
  EXPECT_GE(audit.box.standard_deviation, 0) << what;
  EXPECT_TRUE(std::isfinite(audit.box.quantum)) << what;
  for (const double c : audit.box.correlation) EXPECT_TRUE(std::isfinite(c)) << what;
  for (const NoiseAt& part : audit.box.over_time) EXPECT_TRUE(std::isfinite(part.deviation)) << what;
}

TEST(NoNumbers, InARecordLeaveItsNoiseFinite) {
  for (const double bad : {std::nan(""), static_cast<double>(INFINITY), -static_cast<double>(INFINITY)}) {
    MeasuredRun run = swing(2000);
    run.x_box.front() = run.x_box.back() = run.x_box[500] = bad;
    expect_finite(run, "three frames");
    for (std::size_t i = 0; i < run.x_box.size(); i += 2) run.x_box[i] = bad;
    expect_finite(run, "every second frame");
    for (double& x : run.x_box) x = bad;
    expect_finite(run, "every frame");
  }
  MeasuredRun rests = swing(2000);
  for (double& x : rests.x_box) x = 0.01;
  expect_finite(rests, "at rest");
}

}  // namespace
