// SPDX-License-Identifier: MIT
// Recordings with one mistake each: it is named, with what to write; a good recording is left in peace.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects.hpp"
#include "physics.hpp"
#include "prelude.hpp"
#include "random.hpp"
#include "recording_check.hpp"
#include "rough_motion.hpp"
#include "setup_file.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

using DamperSetup = shakedown::Setup;

/// A box that swings with linear decay, and grains that fly straight until an end wall takes them along.
MeasuredRun recorded(const std::string& name, double box_length) {
  constexpr double interval = 2e-3, release = 0.1075, decay = 8e-3, noise = 2e-4, layer = 8e-3;
  constexpr double omega = 2 * std::numbers::pi * 1.1;
  const double room = box_length / 2 - layer;
  MeasuredRun run;
  run.name = name;
  run.box_length = box_length;
  run.origin_stated = true;
  Random random(1, 0, Stream::packing);
  double grains = release + room, speed = 0;
  for (int i = 0; i < 4000; ++i) {
    const double t = i * interval, amplitude = release - decay * t;
    const double box = amplitude * std::cos(omega * t), box_speed = -omega * amplitude * std::sin(omega * t);
    grains += speed * interval;
    if (grains > box + room) grains = box + room, speed = std::min(speed, box_speed);
    if (grains < box - room) grains = box - room, speed = std::max(speed, box_speed);
    run.time.push_back(t);
    run.x_box.push_back(box + noise * random.normal());
    run.x_com.push_back(grains + noise * random.normal());
  }
  return run;
}

Experiment three_runs() {
  Experiment experiment;
  experiment.runs = {recorded("a", 0.04), recorded("b", 0.065), recorded("c", 0.085)};
  return experiment;
}

std::vector<DamperSetup> setups_for(const Experiment& experiment) {
  std::vector<DamperSetup> setups(experiment.runs.size());
  for (std::size_t i = 0; i < setups.size(); ++i) setups[i].box.length = experiment.runs[i].box_length;
  return setups;
}

struct Said {
  std::string notes, impossible;
};

Said said_of(const Experiment& experiment, const std::vector<DamperSetup>& setups) {
  const RecordingCheck check = check_recordings(experiment, setups);
  Said said;
  for (const std::string& note : check.notes) said.notes += note + "\n";
  for (const Violation& violation : check.impossible) said.impossible += to_string(violation) + "\n";
  return said;
}
Said said_of(const Experiment& experiment) { return said_of(experiment, setups_for(experiment)); }

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

/// x to a x + b in every run, box and grains.
Experiment changed(double factor, double shift) {
  Experiment experiment = three_runs();
  for (MeasuredRun& run : experiment.runs)
    for (std::vector<double>* series : {&run.x_box, &run.x_com})
      for (double& x : *series) x = factor * x + shift;
  return experiment;
}

TEST(RecordingCheck, LeavesAGoodRecordingInPeace) {
  const Said said = said_of(three_runs());
  EXPECT_EQ(said.notes, "");
  EXPECT_EQ(said.impossible, "");
}

TEST(RecordingCheck, SeesRoughNumbers) {
  const MeasuredRun run = recorded("a", 0.04);
  const RoughMotion motion = rough_motion(run.time, run.x_box);
  WITHIN(motion.frequency, 1.1, 0.01, 1.1e-3);     // from turning points between frames
  WITHIN(motion.amplitude, 0.1065, 1e-3, 5.6e-4);  // half a swing later 3.6 mm less
  WITHIN(motion.centre, 0, 8e-5, 4.1e-6);
  WITHIN(motion.noise, 2e-4, 2e-5, 5.3e-6);
  WITHIN(motion.unbroken, 1, 2e-12, 1.2e-13);
}

TEST(RecordingCheck, PowersOfTenAreNamedWithTheUnit) {
  expect_parts(said_of(changed(0.1, 0)).impossible,
               {"off by a factor of 10", "unit = \"cm\"", "likewise b, c"});
  expect_parts(said_of(changed(10, 0)).impossible,
               {"off by a factor of 10", "unit = \"mm\" where it says cm"});
  expect_parts(said_of(changed(1000, 0)).impossible, {"unit = \"mm\" where it says m"});
  Experiment microseconds = three_runs();
  for (MeasuredRun& run : microseconds.runs)
    for (double& t : run.time) t *= 1e6;
  expect_parts(said_of(microseconds).impossible, {"the clock is in another unit", "unit = \"us\""});
  Experiment slow = three_runs();
  for (MeasuredRun& run : slow.runs)
    for (double& t : run.time) t *= 2;
  const Said half = said_of(slow);
  expect_parts(half.impossible, {"swings at 0.55", "frame_rate = \"", "spring.frequency"});
}

// An acceleration of the laboratory at a third of the spring's frequency: the release has died away after
// three seconds, and the box swings at the pace of what drives it.
TEST(RecordingCheck, ADrivenSwingThatOutlastsTheReleaseIsNoWrongClock) {
  Experiment driven = three_runs();
  driven.runs.pop_back();  // grains of the long box fly: they swing more like a spring than such a box does
  for (MeasuredRun& run : driven.runs)
    for (std::size_t i = 0; i < run.time.size(); ++i) {
      const double t = run.time[i], left = std::max(0.0, 1 - t / 3) - (1 - 8e-3 / 0.1075 * t);
      const double moved = 0.1075 * left * std::cos(2 * std::numbers::pi * 1.1 * t) +
                           0.02 * (1 - std::exp(-t)) * std::sin(2 * std::numbers::pi * 0.35 * t);
      run.x_box[i] += moved;
      run.x_com[i] += moved;  // the grains keep their places in the box
    }
  const RoughMotion motion = rough_motion(driven.runs[0].time, driven.runs[0].x_box);
  EXPECT_LT(motion.frequency, 0.6);
  WITHIN(motion.first_frequency, 1.1, 0.1, 0.018);
  EXPECT_EQ(said_of(driven).impossible, "");
  for (MeasuredRun& run : driven.runs)
    for (double& t : run.time) t *= 4;
  expect_parts(said_of(driven).impossible, {"frame_rate = \"", "spring.frequency"});
}

TEST(RecordingCheck, AnOriginThatIsOffIsNamed) {
  const Said little = said_of(changed(1, 2e-3));
  EXPECT_EQ(little.impossible, "");
  expect_parts(little.notes, {"swings about x = 2", "move the origin"});
  Experiment far = changed(1, 0.25);
  for (MeasuredRun& run : far.runs) run.origin_stated = false;
  expect_parts(said_of(far).impossible, {"write origin = \"250 mm\""});
  std::vector<DamperSetup> empty = setups_for(far);
  for (DamperSetup& setup : empty) setup.grains.count = 0;
  EXPECT_EQ(said_of(far, empty).impossible, "");  // unknown, and fitted
}

// Gravity along the motion, as the setup has it: the box swings about where the two hold it.
TEST(RecordingCheck, WhatTheSetupPullsByIsNoWrongOrigin) {
  constexpr double pull = 2.5;  // m/s^2, a fourth of gravity: 49 mm
  std::vector<DamperSetup> pulled = setups_for(three_runs());
  for (DamperSetup& setup : pulled)
    setup = with_overrides(
        std::move(setup),
        std::vector<Override>{{"constant_acceleration.acceleration.x", std::to_string(pull) + " m/s^2"}},
        all_effects());
  const Physics physics = physics_of(pulled[0]);
  const double away = (physics.box.constant.sum() + 37 * 4.04e-3 * pull) / physics.stiffness;
  for (DamperSetup& setup : pulled) setup.release.displacement += away;
  const Said said = said_of(changed(1, away), pulled);
  EXPECT_EQ(said.impossible, "");
  EXPECT_EQ(said.notes.find("swings about"), std::string::npos) << said.notes;
  const Said elsewhere = said_of(changed(1, away + 2e-3), pulled);
  expect_parts(elsewhere.notes, {"steady forces hold it", "move the origin by 2"});
}

TEST(RecordingCheck, TheOtherSideIsNamed) {
  expect_parts(said_of(changed(-1, 0)).impossible, {"starts on the other side", "reversed = true"});
}

TEST(RecordingCheck, SwappedColumnsAreNamed) {
  Experiment experiment = three_runs();
  for (MeasuredRun& run : experiment.runs) std::swap(run.x_box, run.x_com);
  expect_parts(said_of(experiment).impossible, {"the two columns are swapped", "exchange"});
}

// Grains that weigh more than their box shake it: their centre swings like a spring and the box does not.
TEST(RecordingCheck, HeavyGrainsAreNoSwappedColumns) {
  constexpr double box_mass = 0.15, grain_mass = 4e-3, count = 63, omega = 2 * std::numbers::pi * 1.03,
                   of_grains = 0.62 * omega, swing = 0.08;
  Experiment experiment;
  experiment.runs = {recorded("a", 0.049)};
  MeasuredRun& run = experiment.runs.front();
  Random random(4, 0, Stream::packing);
  // M x'' + N m c'' = -M omega^2 x, c being one cosine.
  const double forced = count * grain_mass * of_grains * of_grains * swing /
                        (box_mass * (omega * omega - of_grains * of_grains));
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    run.x_com[i] = swing * std::cos(of_grains * run.time[i]) + 2e-4 * random.normal();
    run.x_box[i] = forced * std::cos(of_grains * run.time[i]) + 0.05 * std::cos(omega * run.time[i]) +
                   2e-4 * random.normal();
  }
  std::vector<DamperSetup> setups = setups_for(experiment);
  setups[0].box.mass = box_mass, setups[0].grains.mass = grain_mass, setups[0].grains.count = 63;
  setups[0].spring.frequency = 1.03, setups[0].release.displacement = forced + 0.05;
  EXPECT_EQ(said_of(experiment, setups).impossible.find("swapped"), std::string::npos);
}

// A shaken damper far from its resonance: grains and box both swing as they are shaken.
TEST(RecordingCheck, AShakenDamperHasNoSwappedColumns) {
  Experiment experiment = three_runs();
  for (MeasuredRun& run : experiment.runs) std::swap(run.x_box, run.x_com);
  std::vector<DamperSetup> setups = setups_for(experiment);
  for (DamperSetup& setup : setups)
    set_number(setup, "oscillating_acceleration.amplitude.x", 0.3, all_effects());
  EXPECT_EQ(said_of(experiment, setups).impossible.find("swapped"), std::string::npos);
}

TEST(SlowRecordingCheck, LateStartsAndLeadInsAreNamed) {
  Experiment early = three_runs();
  for (MeasuredRun& run : early.runs) {
    const std::size_t rest = 150;
    for (double& t : run.time) t += 0.3;
    for (std::size_t i = 0; i < rest; ++i) {
      run.time.insert(run.time.begin(), 0.3 - 0.002 * static_cast<double>(i + 1));
      run.x_box.insert(run.x_box.begin(), run.x_box[2 * i]);
      run.x_com.insert(run.x_com.begin(), run.x_com[2 * i]);
    }
    for (std::size_t i = 0; i < rest; ++i) run.x_box[i] = 0.1075 + (i % 2 ? 1e-4 : -1e-4);
  }
  expect_parts(said_of(early).impossible, {"stands still for the first 0.29", "release_time = \"0.29"});
  const Experiment put_right = with_releases_seen(early, setups_for(early));
  EXPECT_EQ(said_of(put_right).impossible, "");
  ASSERT_EQ(put_right.notes.size(), 3u);
  expect_parts(put_right.notes[0], {"a: the box is held for 0.", "let go at 0.", "release_time = \"0."});
  WITHIN(static_cast<double>(put_right.runs[0].lead_in.time.size()), 150, 2, 0.5);
  WITHIN(put_right.runs[0].time.front(), 0, 4e-3, 1.8e-3);
  Experiment late = three_runs();
  for (MeasuredRun& run : late.runs) {
    run.time.resize(run.time.size() - 25);
    run.x_box.erase(run.x_box.begin(), run.x_box.begin() + 25);
    run.x_com.erase(run.x_com.begin(), run.x_com.begin() + 25);
  }
  expect_parts(said_of(late).notes, {"after a release from rest", "release_time = \"-0.05"});
  Experiment offset = three_runs();
  for (MeasuredRun& run : offset.runs)
    for (double& t : run.time) t += 12.5;
  expect_parts(said_of(offset).notes, {"first frame is at 12.5 s", "release_time = \"12.5 s\""});
}

TEST(RecordingCheck, TooManyMissingFramesAreRefused) {
  Experiment experiment = three_runs();
  Random random(2, 0, Stream::packing);
  for (double& x : experiment.runs[1].x_box)
    if (random.uniform() < 0.7) x = NAN;
  expect_parts(said_of(experiment).impossible, {"b: box_position", "has too few frames in a row"});
  experiment = three_runs();
  for (std::size_t i = 0; i < experiment.runs[0].x_com.size(); ++i)
    if (i % 4) experiment.runs[0].x_com[i] = NAN;  // every fourth frame tracked
  for (double& x : experiment.runs[1].x_box)
    if (random.uniform() < 0.05) x = NAN;
  EXPECT_EQ(said_of(experiment).impossible, "");
}

TEST(RecordingCheck, ARunUnderTheWrongLengthIsNamed) {
  const Experiment experiment = three_runs();
  std::vector<DamperSetup> setups = setups_for(experiment);
  setups[0].box.length = 0.045;
  expect_parts(said_of(experiment, setups).notes, {"a: box_length", "box_length = \"40", "not 45 mm"});
  setups = setups_for(experiment);
  Experiment more = experiment;
  more.runs.push_back(recorded("d", 0.104));
  setups.push_back(setups[0]);
  setups[3].box.length = 0.104;
  std::swap(setups[1].box.length, setups[3].box.length);
  expect_parts(said_of(more, setups).notes, {"b: box_length", "Exchanged with d?"});
}

/// The cells of one column, as another unit, side or origin would have them.
Experiment with_grains(double factor, double shift) {
  Experiment experiment = three_runs();
  for (MeasuredRun& run : experiment.runs)
    for (double& x : run.x_com) x = factor * x + shift;
  return experiment;
}

TEST(RecordingCheck, GrainsDoNotLeaveTheirBox) {
  expect_parts(said_of(with_grains(1000, 0)).impossible,
               {"outside of the box", "unit = \"mm\" where it says m"});
  expect_parts(said_of(with_grains(0.1, 0)).impossible, {"unit = \"cm\" where it says mm"});
  expect_parts(said_of(with_grains(-1, 0)).impossible, {"reversed = true in [column.grain_centre]"});
  expect_parts(said_of(with_grains(1, 0.2)).impossible,
               {"move the origin of [column.grain_centre] by 200 mm"});
  expect_parts(said_of(with_grains(0, 0.05)).impossible, {"stands still while the box swings"});
}

TEST(RecordingCheck, WrongFramesMakeNoAdvice) {
  Experiment experiment = three_runs();
  Random random(3, 0, Stream::packing);
  for (MeasuredRun& run : experiment.runs)
    for (std::size_t i = 10; i < run.x_box.size(); ++i)
      if (random.uniform() < 0.01) run.x_box[i] = run.x_com[i] = 0.2;
  experiment.runs[0].x_box[500] = 10;
  const Said said = said_of(experiment);
  EXPECT_EQ(said.notes, "");
  EXPECT_EQ(said.impossible, "");
}

/// Every so manieth frame.
Experiment thinned(std::size_t step) {
  Experiment experiment = three_runs();
  for (MeasuredRun& run : experiment.runs)
    for (std::vector<double>* series : {&run.time, &run.x_box, &run.x_com}) {
      std::vector<double> kept;
      for (std::size_t i = 0; i < series->size(); i += step) kept.push_back((*series)[i]);
      *series = kept;
    }
  return experiment;
}

TEST(RecordingCheck, AReleaseFilmedSlowlyIsNoLeadIn) {
  for (const std::size_t step : {5u, 8u, 16u}) EXPECT_EQ(said_of(thinned(step)).impossible, "") << step;
}

TEST(RecordingCheck, TooFewFramesASwingAreRefused) {
  const Experiment experiment = thinned(100);
  expect_parts(said_of(experiment).impossible, {"frames a swing", "10 are the least"});
}

TEST(RecordingCheck, ABoxThatStandsStillIsRefused) {
  Experiment experiment = three_runs();
  for (double& x : experiment.runs[0].x_box) x = 0.1;
  expect_parts(said_of(experiment).impossible, {"a: box", "does not swing"});
}

}  // namespace
}  // namespace shakedown
