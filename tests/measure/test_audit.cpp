// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "measurement.hpp"
#include "random.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

/// A swinging box with kinks where a layer lands, seen by a camera with first-order noise of correlation r.
MeasuredRun recorded(double rate, double noise, double r, std::uint64_t seed, double bias = 0,
                     double length = 0.04) {
  Random random(seed, 0, Stream::camera);
  MeasuredRun run;
  run.name = "run";
  run.box_length = length;
  double error = noise * random.normal(), grain_error = 2.5 * noise * random.normal();
  for (int i = 0; i < static_cast<int>(20 * rate); ++i) {
    const double t = i / rate, phase = std::fmod(t * 2.1, 1.0);
    error = r * error + std::sqrt(1 - r * r) * noise * random.normal();
    grain_error = r * grain_error + std::sqrt(1 - r * r) * 2.5 * noise * random.normal();
    const double x = 0.1075 * std::exp(-t / 10) * std::cos(6.6 * t) + 0.004 * std::abs(phase - 0.5);
    const double side = std::clamp(4 * std::cos(6.6 * t), -1.0, 1.0);  // packed at one end or the other
    run.time.push_back(t);
    run.x_box.push_back(x + error);
    run.x_com.push_back(x + (1 - bias) * side * (length / 2 - 0.008) + grain_error);
  }
  return run;
}

Measurement measured(const Experiment& experiment) {
  return measurement_of(std::vector<shakedown::Setup>(experiment.runs.size()), experiment);
}

TEST(Audit, FindsWhiteNoise) {
  for (const double rate : {250.0, 500.0}) {
    const RunAudit audit = audit_run(recorded(rate, 2e-4, 0, 1));
    WITHIN(audit.box.standard_deviation / 2e-4, 1, 0.08, 0.04) << rate;
    EXPECT_EQ(audit.box.correlation[0], 0);
    EXPECT_EQ(audit.box.outliers, 0);
    WITHIN(audit.frame_interval, 1 / rate, 7e-14, 3.6e-15);  // rounding of 20 s
  }
}

TEST(Audit, GrainsTrackedInEveryFourthFrameAreKeptAndTheirNoiseFound) {
  MeasuredRun run = recorded(500, 2e-4, 0, 7);
  for (std::size_t i = 0; i < run.x_com.size(); ++i)
    if (i % 4) run.x_com[i] = std::nan("");
  const RunAudit audit = audit_run(run);
  const auto kept =
      std::count_if(audit.x_com.begin(), audit.x_com.end(), [](double x) { return std::isfinite(x); });
  EXPECT_GE(kept, 2495);  // of 2500
  WITHIN(audit.com.standard_deviation / 5e-4, 1, 0.1, 0.095);
  WITHIN(audit.box.standard_deviation / 2e-4, 1, 0.08, 0.04);
}

TEST(Audit, FewFramesAreNotCalledWrong) {
  MeasuredRun run = recorded(500, 2e-4, 0, 8);
  for (std::size_t i = 0; i < run.x_com.size(); ++i)
    if (i % 5 > 2) run.x_com[i] = std::nan("");
  run.com_uncertainty = 7e-4;
  const RunAudit audit = audit_run(run);
  EXPECT_EQ(audit.com.outliers, 0);
  EXPECT_DOUBLE_EQ(audit.com.standard_deviation, 7e-4);
}

TEST(SlowAudit, TheLayerOfOtherGrainsHasItsOwnThickness) {
  Experiment experiment;
  for (const double length : {0.04, 0.065, 0.104})
    experiment.runs.push_back(recorded(500, 2e-4, 0, 9, 0, length));
  const double alone = measured(experiment).plateau.slope;
  experiment.runs.push_back(recorded(500, 2e-4, 0, 10, 0, 0.03));  // as thin as with half the grains
  experiment.runs.back().overrides = {{"grains.count", "18", ""}};
  experiment.runs.back().box_length = 0.04;
  experiment.runs.push_back(recorded(500, 2e-4, 0, 11));
  experiment.runs.back().box_length = std::nan("");
  EXPECT_DOUBLE_EQ(measured(experiment).plateau.slope, alone);
  WITHIN(alone, 0.5, 5e-4, 3.1e-5);
}

TEST(Audit, FindsTheColour) {
  for (const double r : {-0.3, 0.2, 0.5}) {
    const RunAudit audit = audit_run(recorded(500, 2e-4, r, 2));
    WITHIN(audit.box.correlation[0], r, 0.03, 0.02);
    WITHIN(audit.box.standard_deviation / 2e-4, 1, 0.1, 0.04);
  }
}

TEST(Audit, TakesOutOutliersOnly) {
  MeasuredRun run = recorded(500, 2e-4, 0, 3);
  Random random(4, 0, Stream::other);
  int wrong = 0;
  for (double& x : run.x_box)
    if (random.uniform() < 0.02)
      x += (random.uniform() < 0.5 ? -1 : 1) * (0.003 + 0.02 * random.uniform()), ++wrong;
  const RunAudit audit = audit_run(run);
  WITHIN(audit.box.outliers, wrong, 5, 0.5);
  WITHIN(audit.box.standard_deviation / 2e-4, 1, 0.1, 0.04);
}

/// The second frame of each pair lies where the line through its neighbour and the frame before points, so
/// that the two support each other.
TEST(Audit, TakesOutOutliersThatSupportEachOther) {
  MeasuredRun run = recorded(500, 2e-4, 0, 3);
  const std::vector<double> right = run.x_box;
  constexpr double jump = 0.008;
  int pairs = 0;
  for (std::size_t i = 100; i + 100 < run.x_box.size(); i += 150, ++pairs)
    run.x_box[i] += jump, run.x_box[i + 1] += 2 * jump;
  const RunAudit audit = audit_run(run);
  int kept = 0, lost = 0;
  for (std::size_t i = 0; i < right.size(); ++i) {
    const bool wrong = run.x_box[i] != right[i];
    kept += wrong && std::isfinite(audit.x_box[i]);
    lost += !wrong && !std::isfinite(audit.x_box[i]);
  }
  EXPECT_GT(pairs, 10);
  EXPECT_EQ(kept, 0);
  EXPECT_LE(lost, pairs / 2);  // right frames beside wrong ones
}

/// Jumps evenly spread: those too small to be told from noise widen it as they do in truth.
TEST(Audit, OutliersTooSmallToBeSeenCountAsNoise) {
  MeasuredRun run = recorded(500, 2e-4, 0, 3);
  const std::vector<double> right = run.x_box;
  Random random(4, 0, Stream::other);
  for (double& x : run.x_box)
    if (random.uniform() < 0.05) x += 0.005 * (2 * random.uniform() - 1);
  const RunAudit audit = audit_run(run);
  double squares = 0, frames = 0;
  for (std::size_t i = 0; i < right.size(); ++i)
    if (std::isfinite(audit.x_box[i])) squares += std::pow(audit.x_box[i] - right[i], 2), ++frames;
  const double truth = std::hypot(2e-4, std::sqrt(squares / frames));
  std::printf("found %.4g mm, true %.4g mm\n", 1e3 * audit.box.standard_deviation, 1e3 * truth);
  WITHIN(audit.box.standard_deviation / truth, 1, 0.1, 0.04);
}

TEST(Audit, CountsGaps) {
  MeasuredRun run = recorded(500, 2e-4, 0, 5);
  for (std::size_t i = 1000; i < 1010; ++i) run.x_box[i] = NAN;
  for (auto* series : {&run.time, &run.x_box, &run.x_com})
    series->erase(series->begin() + 2000, series->begin() + 2005);
  const RunAudit audit = audit_run(run);
  EXPECT_EQ(audit.box.missing, 15);
  WITHIN(audit.box.longest_gap, 0.02, 3e-16, 1.8e-17);
  EXPECT_EQ(audit.com.missing, 5);
}

TEST(Audit, ReleaseOfTheBox) {
  const RunAudit audit = audit_run(recorded(500, 2e-4, 0, 6));
  WITHIN_ERRORS(audit.release.displacement, 0.1095, 5, audit.release.displacement_error, 1e-4);
}

TEST(Audit, PixelSteps) {
  MeasuredRun run = recorded(500, 1e-5, 0, 7);
  for (double& x : run.x_box) x = std::round(x / 1e-3) * 1e-3;
  const RunAudit audit = audit_run(run);
  WITHIN(audit.box.quantum, 1e-3, 2e-16, 1.4e-17);  // rounding of 0.1 m
  EXPECT_EQ(audit_run(recorded(500, 2e-4, 0, 8)).box.quantum, 0);
}

TEST(SlowAudit, PlateauSlopeTellsABias) {
  for (const double bias : {0.0, 0.08}) {
    Experiment experiment;
    std::uint64_t seed = 10;
    for (const double length : {0.04, 0.065, 0.085, 0.104})
      experiment.runs.push_back(recorded(500, 2e-4, 0, seed++, bias, length));
    const Measurement result = measured(experiment);
    WITHIN_ERRORS(result.plateau.slope, (1 - bias) / 2, 4, result.plateau.error, 0.004);
  }
}

TEST(Audit, WarnsWhenTheDeclaredNoiseIsWrong) {
  Experiment experiment;
  experiment.runs.push_back(recorded(500, 2e-4, 0, 9));
  const std::vector<std::string> none = measured(experiment).warnings;
  EXPECT_TRUE(none.empty()) << none.front();
  experiment.runs[0].box_uncertainty = 5e-5;
  ASSERT_EQ(measured(experiment).warnings.size(), 1u);
  EXPECT_NE(measured(experiment).warnings[0].find("0.05 mm"), std::string::npos);
}

}  // namespace
}  // namespace shakedown
