// SPDX-License-Identifier: MIT
#include "measurements.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "effects.hpp"
#include "engines.hpp"
#include "experiment_file.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

shakedown::Setup short_damper(double seconds = 2) {
  shakedown::Setup setup;
  setup.run.duration = seconds;
  return setup;
}

Experiment measure(const shakedown::Setup& truth, const RecordingSettings& recording, int threads = 1,
                   std::uint64_t seed = 5, const std::vector<double>& lengths = {0.04}) {
  const auto engine = engine_named("hard");
  return make_measurements(truth, runs_of_lengths(lengths), recording,
                           {engine.get(), all_effects(), seed, threads, nullptr});
}

RecordingSettings noiseless() {
  RecordingSettings recording;
  recording.box_noise = recording.centre_noise = 0;
  return recording;
}

double deviation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TEST(Measurements, WithoutNoiseTheTableHoldsTheEnginesMotionToTheMicrometre) {
  const Experiment experiment = measure(short_damper(), noiseless());
  shakedown::Setup setup = short_damper();
  setup.run.seed = 5;
  const Trajectory truth = engine_named("hard")->run(setup);
  const MeasuredRun& run = experiment.runs.at(0);
  ASSERT_EQ(run.time.size(), truth.time.size());
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    WITHIN(run.x_box[i], truth.x_box[i], 0.5001e-6, 5e-7);
    WITHIN(run.x_com[i], truth.x_com[i], 0.5001e-6, 5e-7);
  }
}

TEST(Measurements, NoiseHasTheStatedSizeAndNoTrend) {
  const Experiment still = measure(short_damper(4), noiseless()), noisy = measure(short_damper(4), {});
  // 2001 frames: the standard error of a standard deviation is 1.6 %.
  WITHIN(deviation(noisy.runs[0].x_box, still.runs[0].x_box) / 0.2e-3, 1, 0.06, 0.016);
  WITHIN(deviation(noisy.runs[0].x_com, still.runs[0].x_com) / 0.5e-3, 1, 0.06, 0.016);
  double product = 0;
  for (std::size_t i = 1; i < noisy.runs[0].time.size(); ++i)
    product += (noisy.runs[0].x_box[i] - still.runs[0].x_box[i]) *
               (noisy.runs[0].x_box[i - 1] - still.runs[0].x_box[i - 1]);
  EXPECT_LT(std::abs(product / (2000 * 0.04e-6)), 0.09);  // 4 standard errors of a correlation
}

TEST(Measurements, MissingFramesAndJumpsComeAtTheStatedRateAndLeaveTheOthersAlone) {
  RecordingSettings bad;
  bad.missing = 0.1, bad.outliers = 0.05;
  const Experiment clean = measure(short_damper(4), {}), worse = measure(short_damper(4), bad);
  int missing = 0, moved = 0;
  for (std::size_t i = 0; i < clean.runs[0].time.size(); ++i) {
    if (std::isnan(worse.runs[0].x_box[i]))
      ++missing;
    else if (worse.runs[0].x_box[i] != clean.runs[0].x_box[i])
      ++moved;
  }
  WITHIN(missing, 200, 60, 14);  // standard errors of 2001 frames
  WITHIN(moved, 90, 40, 9.3);
}

TEST(Measurements, AnEmptyBoxAndAnUntrackedRunHaveNoCentre) {
  RecordingSettings blind;
  blind.centre = false;
  EXPECT_FALSE(measure(short_damper(), blind).runs[0].has_com());
  const auto engine = engine_named("hard");
  const Experiment empty = make_measurements(short_damper(), {{"empty", {{"grains.count", "0"}}}}, {},
                                             {engine.get(), all_effects(), 1, 1, nullptr});
  EXPECT_FALSE(empty.runs[0].has_com());
  EXPECT_EQ(empty.runs[0].time.size(), 1001u);
}

TEST(Measurements, ALateClockShiftsEveryTimeAndAnEarlyOneLosesTheFirstFrames) {
  shakedown::Setup late = short_damper(), early = short_damper();
  set_number(late, "camera_time_offset.offset", 0.004, all_effects());
  set_number(early, "camera_time_offset.offset", -0.004, all_effects());
  const Experiment given = measure(short_damper(), noiseless()), after = measure(late, noiseless()),
                   before = measure(early, noiseless());
  WITHIN(after.runs[0].time.front(), 0.004, 1e-17, 8.9e-19);
  EXPECT_EQ(after.runs[0].x_box, given.runs[0].x_box);
  EXPECT_EQ(before.runs[0].time.size(), given.runs[0].time.size() - 2);
  EXPECT_EQ(before.runs[0].x_box.front(), given.runs[0].x_box[2]);
}

TEST(Measurements, AreTheSameForAnyNumberOfThreadsAndDifferentForAnotherSeed) {
  const std::vector<double> lengths{0.04, 0.04, 0.065};
  const Experiment one = measure(short_damper(), {}, 1, 5, lengths),
                   three = measure(short_damper(), {}, 3, 5, lengths);
  for (std::size_t r = 0; r < one.runs.size(); ++r) {
    EXPECT_EQ(one.runs[r].x_box, three.runs[r].x_box);
    EXPECT_EQ(one.runs[r].x_com, three.runs[r].x_com);
  }
  EXPECT_NE(one.runs[0].x_box, one.runs[1].x_box);
  EXPECT_NE(one.runs[0].x_box, measure(short_damper(), {}, 1, 6, lengths).runs[0].x_box);
}

TEST(Measurements, ReadBackFromTheirFilesAsTheyWere) {
  const ScratchFolder folder;
  RecordingSettings recording;
  recording.missing = 0.05;
  const Experiment experiment = measure(short_damper(), recording, 1, 5, {0.04, 0.04, 0.104});
  write_measurements(folder.path(), experiment);
  const Experiment back = read_experiment(folder / "experiment.toml");
  ASSERT_EQ(back.runs.size(), 3u);
  EXPECT_EQ(back.runs[1].name, "L040_b");
  for (std::size_t r = 0; r < back.runs.size(); ++r) {
    EXPECT_EQ(back.runs[r].box_length, experiment.runs[r].box_length);
    EXPECT_EQ(back.runs[r].box_uncertainty, 0.2e-3);
    ASSERT_EQ(back.runs[r].time.size(), experiment.runs[r].time.size());
    for (std::size_t i = 0; i < back.runs[r].time.size(); ++i) {
      WITHIN(back.runs[r].time[i], experiment.runs[r].time[i], 9e-15, 4.5e-16);
      const double wrote = experiment.runs[r].x_box[i], read = back.runs[r].x_box[i];
      EXPECT_TRUE(std::isnan(wrote) ? std::isnan(read) : std::abs(wrote - read) < 1e-12) << i;
    }
  }
}

TEST(Measurements, RunsAreNamedByLength) {
  const std::vector<PlannedRun> runs = runs_of_lengths({0.04, 0.04, 0.065, 0.0855, 0.311});
  std::vector<std::string> names;
  for (const PlannedRun& run : runs) names.push_back(run.name);
  EXPECT_EQ(names, (std::vector<std::string>{"L040_a", "L040_b", "L065", "L085.5", "L311"}));
}
