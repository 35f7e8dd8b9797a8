// SPDX-License-Identifier: MIT
// The laboratory's camera against the model's: two codes, one camera.
#include "film.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects.hpp"
#include "engines.hpp"
#include "experiment_file.hpp"
#include "hidden_case.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

Trajectory damper(double rate) {
  shakedown::Setup setup;
  setup.run.duration = 3;
  setup.run.sample_rate = rate;
  return engine_named("hard")->run(setup);
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

constexpr Camera ordinary{.shutter = 1e-3,
                          .centre_bias = 0.02,
                          .arc_length = 0.59,
                          .depth = 0.005,
                          .lens = 0.005,
                          .scale = 0.01,
                          .drift = 1e-4,
                          .origin = 1e-3,
                          .time_offset = 2e-3};

Experiment measured(const RecordingSettings& recording, std::uint64_t seed = 3, int grains = 37) {
  shakedown::Setup setup;
  setup.grains.count = grains;
  setup.run.duration = 2;
  const auto engine = engine_named("hard");
  return make_measurements(setup, runs_of_lengths({0.04, 0.04, 0.04, 0.04}), recording,
                           {engine.get(), all_effects(), seed, 1, nullptr});
}

RecordingSettings noiseless() {
  RecordingSettings recording;
  recording.box_noise = recording.centre_noise = 0;
  return recording;
}

}  // namespace

TEST(Film, IsWhatTheModelsCameraRecords) {
  const Trajectory motion = damper(500);
  const Frames frames = even_frames(500, 0, 3);
  const Recording film = filmed(ordinary, frames, motion), model = recorded_by(ordinary, motion);
  EXPECT_LT(farthest(film.time, model.time), 1e-12);
  // Around the grains' impacts the model follows cubics over 12 ms, the laboratory the motion itself.
  EXPECT_LT(farthest(film.x_box, model.x_box), 2e-5);
  EXPECT_LT(farthest(film.x_com, model.x_com), 1e-4);
  Camera global = ordinary;
  global.shutter = 0;
  const Recording same = filmed(global, frames, motion), as_model = recorded_by(global, motion);
  EXPECT_LT(farthest(same.x_box, as_model.x_box), 1e-15);
  EXPECT_LT(farthest(same.x_com, as_model.x_com), 1e-15);
}

// A camera's error that the laboratory does not make could be hidden and never be found.
TEST(Film, EveryErrorThatTheModelKnowsIsMadeAndAlike) {
  const Trajectory motion = damper(500);
  const Frames frames = even_frames(500, 0, 3);
  const Recording perfect = filmed({}, frames, motion);
  for (const CameraParameter& parameter : camera_parameters(all_effects())) {
    Camera camera;
    camera.*parameter.field = parameter.typical;
    const Recording film = filmed(camera, frames, motion), model = recorded_by(camera, motion);
    const double made = std::max({farthest(film.time, perfect.time), farthest(film.x_box, perfect.x_box),
                                  farthest(film.x_com, perfect.x_com)});
    EXPECT_GT(made, 1e-5) << parameter.path;
    // The reader of the rows is the one that the model follows to 2e-5 m only (see above).
    const double least = camera.shutter > 0 ? 1e-4 : 1e-15;
    EXPECT_LT(std::max(farthest(film.x_box, model.x_box), farthest(film.x_com, model.x_com)), least)
        << parameter.path;
  }
}

TEST(Film, AnEncoderWritesARowWhereTheBoxPassesAnEdge) {
  RecordingSettings recording = noiseless();
  recording.edge = recording.rounding = 2e-3;
  const MeasuredRun edges = measured(recording, 3, 0).runs[0], exact = measured(noiseless(), 3, 0).runs[0];
  ASSERT_GT(edges.time.size(), 300u);
  for (std::size_t i = 1; i < edges.time.size(); ++i) {
    EXPECT_GT(edges.time[i], edges.time[i - 1]);
    EXPECT_LT(std::abs(edges.x_box[i] - edges.x_box[i - 1]), 2.001e-3) << "no edge is passed over";
  }
  // Where a frame of the even clock lies between two edges, so does its position.
  for (std::size_t k = 1, i = 0; k < exact.time.size(); ++k) {
    while (i < edges.time.size() && edges.time[i] < exact.time[k]) ++i;
    if (i == 0 || i == edges.time.size()) continue;
    const double low = std::min(edges.x_box[i - 1], edges.x_box[i]),
                 high = std::max(edges.x_box[i - 1], edges.x_box[i]);
    EXPECT_GT(exact.x_box[k], low - (low == high ? 2.002e-3 : 2e-6)) << exact.time[k];
    EXPECT_LT(exact.x_box[k], high + (low == high ? 2.002e-3 : 2e-6)) << exact.time[k];
  }
}

TEST(Film, ALateClockMissesTheReleaseAndAnEarlyOneSeesTheBoxRest) {
  const Trajectory motion = damper(1000);
  const Recording late = filmed({}, even_frames(500, 3e-3, 3), motion),
                  early = filmed({}, even_frames(500, -3e-3, 3), motion);
  WITHIN(late.x_box.front(), motion.x_box[3], 4e-16, 2.4e-17);
  EXPECT_EQ(early.x_box[0], motion.x_box[0]);
  EXPECT_EQ(early.x_box[1], motion.x_box[0]);
  WITHIN(early.x_box[2], motion.x_box[1], 4e-16, 2.4e-17);
}

TEST(Film, ReleaseAndTriggerScatterByRunAsStated) {
  RecordingSettings recording = noiseless();
  recording.release = 1e-3;
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const MeasuredRun& run : measured(recording, seed).runs)
      sum += std::pow(run.x_box.front() - 0.1075, 2), ++count;
  WITHIN(std::sqrt(sum / count), 1e-3, 0.35e-3, 0.11e-3);  // standard error of 40 draws
  RecordingSettings scattered = noiseless();
  scattered.trigger = 5e-3;
  const Experiment late = measured(scattered), exact = measured(noiseless());
  for (std::size_t r = 0; r < 4; ++r) {
    EXPECT_EQ(late.runs[r].time.front(), 0);
    EXPECT_NE(late.runs[r].x_box[50], exact.runs[r].x_box[50]);
  }
}

TEST(Film, ATableCanStartAnywhereOnAnUnevenClockWithItsOwnOriginAndStep) {
  RecordingSettings recording = noiseless();
  recording.start = 0.1;
  recording.origin = 5e-3;
  const MeasuredRun exact = measured(noiseless()).runs[0], late = measured(recording).runs[0];
  ASSERT_EQ(late.time.size(), exact.time.size() - 50);
  EXPECT_EQ(late.time.front(), 0);
  WITHIN(late.x_box[0], exact.x_box[50] + 5e-3, 1.001e-6, 5e-7);  // both are rounded
  recording = noiseless();
  recording.jitter = 0.5e-3;
  recording.stamped = true;
  const MeasuredRun uneven = measured(recording).runs[0];
  double sum = 0;
  for (std::size_t i = 0; i < uneven.time.size(); ++i)
    sum += std::pow(uneven.time[i] - static_cast<double>(i) / 500, 2);
  WITHIN(std::sqrt(sum / static_cast<double>(uneven.time.size())), 0.5e-3, 0.04e-3, 8e-6);  // standard error
  recording.stamped = false;
  recording.rounding = 1e-3;
  const MeasuredRun unknown = measured(recording).runs[0];
  WITHIN(unknown.time[1], 2e-3, 9e-18, 4.5e-19);
  WITHIN(unknown.x_box[70] * 1e3, std::round(unknown.x_box[70] * 1e3), 3e-13, 1.5e-14);
  EXPECT_NE(unknown.x_box[300], exact.x_box[300]);
}

TEST(Film, TheTrackWandersWithItsMemoryBoxAndCentreApart) {
  RecordingSettings recording = noiseless();
  recording.wander = 0.1e-3;
  recording.wander_time = 0.05;
  const Experiment wandering = measured(recording), exact = measured(noiseless());
  double box = 0, centre = 0, both = 0, later = 0;
  int count = 0;
  constexpr std::size_t memory = 25;  // frames
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t i = 0; i + memory < exact.runs[r].time.size(); ++i, ++count) {
      const auto error = [&](std::size_t at) {
        return wandering.runs[r].x_box[at] - exact.runs[r].x_box[at];
      };
      const double other = wandering.runs[r].x_com[i] - exact.runs[r].x_com[i];
      box += error(i) * error(i), centre += other * other, both += error(i) * other;
      later += error(i) * error(i + memory);
    }
  // 8 s hold some 80 independent stretches: standard errors.
  WITHIN(box / count / 1e-8, 1, 0.5, 0.16);
  WITHIN(centre / count / 1e-8, 1, 0.5, 0.16);
  WITHIN(both / count / 1e-8, 0, 0.4, 0.11);
  WITHIN(later / box, std::exp(-1), 0.3, 0.1);
}

TEST(Film, OptionsOfACameraAsItIsAreRead) {
  const RecordingSettings read =
      parse_recording({"lens=0.5%", "shutter=1ms", "wander=20um/0.3s", "trigger=1ms", "near=0.5%",
                       "release=0.3mm", "fps=240", "missing=1%"});
  RecordingSettings stated;
  stated.lens = stated.near = 0.005;
  stated.shutter = stated.trigger = 1e-3;
  stated.wander = 20e-6, stated.wander_time = 0.3;
  stated.release = 0.3e-3;
  stated.frame_rate = 240, stated.missing = 0.01;
  WITHIN(read.wander, stated.wander, 8e-20, 4.5e-21);
  WITHIN(read.release, stated.release, 1e-18, 6.7e-20);
  EXPECT_EQ(read.lens, stated.lens);
  EXPECT_EQ(read.shutter, stated.shutter);
  EXPECT_EQ(read.wander_time, stated.wander_time);
  EXPECT_EQ(read.frame_rate, stated.frame_rate);
  EXPECT_THROW(parse_recording({"wander=20um/0s"}), InputError);
  EXPECT_THROW(parse_recording({"lens=2"}), InputError);
}

TEST(Film, WhatItsExperimenterKnowsStandsInTheExperimentFile) {
  const ScratchFolder folder;
  RecordingSettings recording;
  recording.frame_rate = 240;
  recording.trigger = 4e-3;
  Experiment experiment = measured(recording);
  experiment.known = with_known(usually_known({}, recording),
                                {"box.mass=437 g +- 2 g", "restitution.grain_grain = 0.95 +- 0.02"});
  write_measurements(folder.path(), experiment);
  const Experiment back = read_experiment(folder / "experiment.toml");
  EXPECT_EQ(find_known(back.known, "box.mass")->value, 0.437);
  EXPECT_EQ(find_known(back.known, "box.mass")->error, 0.002);
  EXPECT_EQ(find_known(back.known, "restitution.grain_grain")->error, 0.02);
  EXPECT_EQ(find_known(back.known, "release.displacement")->error, 0.5e-3);
  EXPECT_EQ(find_known(back.known, "camera.trigger")->error, 4e-3);
  for (std::size_t i = 0; i < 10; ++i)
    WITHIN(back.runs[0].time[i], static_cast<double>(i) / 240, 0.5001e-6, 3.4e-7) << "no coarser clock";
  EXPECT_THROW(with_known({}, {"box.mas=437 g +- 2 g"}), InputError);
  EXPECT_THROW(with_known({}, {"box.mass"}), InputError);
}
