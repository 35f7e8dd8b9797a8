// SPDX-License-Identifier: MIT
#include "ring_down.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <set>

#include "effects.hpp"
#include "engines.hpp"
#include "errors.hpp"
#include "output_file.hpp"
#include "ring_down_signal.hpp"
#include "scratch_folder.hpp"
#include "study_commands.hpp"
#include "waveform_search.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

shakedown::Setup swinging(double damping) {
  shakedown::Setup setup;
  setup.grains.count = 0;
  setup.run.duration = 20;
  set_number(setup, "blade_viscous_damping.damping", damping, all_effects());
  return setup;
}

RecordingSettings white(double noise) {
  RecordingSettings recording;
  recording.box_noise = noise;
  recording.frame_rate = 100;
  return recording;
}

double signal_of(const shakedown::Setup& truth, const RecordingSettings& recording) {
  const auto engine = engine_named("hard");
  return signals_of(truth, {"blade_viscous_damping.damping"}, recording, *engine, all_effects()).at(0);
}

}  // namespace

TEST(RingDowns, TheSignalOfWeakDampingIsThatOfTheClosedForm) {
  // x = A exp(-g t) cos: d x/d ln g = -g t x, and the free amplitude takes the mean of t out: in n frames
  // over T the variance of t is T^2/12, that of the cosine 1/2.
  const double damping = 1e-4, rate = damping / (2 * 0.434), noise = 1e-3;
  const double closed = 0.1075 * rate * 20 / std::sqrt(12.0) * std::sqrt(2001 / 2.0) / noise;
  WITHIN(signal_of(swinging(damping), white(noise)) / closed, 1, 0.02, 3.5e-3);
}

// x + b x^2 / 0.2 m: a constant, which the free origin takes, and half of it twice as fast. Without the
// camera in what is seen its signal was none, and no case with a tilt was ever drawn.
TEST(RingDowns, TheSignalOfATiltIsThatOfTheClosedForm) {
  shakedown::Setup truth = swinging(1e-9);
  set_number(truth, "camera_tilt.tilt", 0.02, all_effects());
  const auto engine = engine_named("hard");
  const double noise = 1e-3, twice_as_fast = 0.02 * std::pow(0.1075, 2) / 2 / 0.2,
               closed = twice_as_fast * std::sqrt(2001 / 2.0) / noise;
  WITHIN(signals_of(truth, {"camera_tilt.tilt"}, white(noise), *engine, all_effects()).at(0) / closed, 1,
         7e-3, 3.7e-4);
}

TEST(RingDowns, WanderAndJitterTakeTheirPartOfTheSignal) {
  const shakedown::Setup truth = swinging(0.01);
  RecordingSettings noise = white(1e-4);
  const double alone = signal_of(truth, noise);
  noise.wander = 1e-4;
  noise.wander_time = 1e-4;  // forgotten from frame to frame: one more white noise of the same size
  WITHIN(signal_of(truth, noise) / alone, std::sqrt(0.5), 3e-5, 1.5e-6);
  noise.wander_time = 0.3;
  EXPECT_LT(signal_of(truth, noise), alone);
  noise.wander = 0;
  noise.jitter = 1e-3;
  const double jittered = signal_of(truth, noise);
  EXPECT_LT(jittered, 0.7 * alone);
  noise.stamped = true;
  EXPECT_DOUBLE_EQ(signal_of(truth, noise), alone);
}

void expect_as_stated(const RingDown& one) {
  EXPECT_GE(one.frames_a_period, 7.9);
  EXPECT_GE(one.weakest(), 4);
  EXPECT_LE(one.hidden.size(), 4u);
  EXPECT_EQ(one.noise == RingDownNoise::edges, one.trial.recording.edge > 0);
  EXPECT_TRUE(one.trial.hidden.believed.effects.empty());
  EXPECT_EQ(one.trial.hidden.truth.grains.count, 0);
}

TEST(RingDowns, AreDrawnAsStatedAndTheSameAgain) {
  const auto engine = engine_named("hard");
  expect_as_stated(draw_ring_down(3, 0, *engine, all_effects()));
  const RingDown once = draw_ring_down(3, 1, *engine, all_effects()),
                 again = draw_ring_down(3, 1, *engine, all_effects());
  expect_as_stated(once);
  EXPECT_EQ(write_setup(once.trial.hidden.truth), write_setup(again.trial.hidden.truth));
  EXPECT_EQ(once.signals, again.signals);
}

TEST(SlowRingDowns, HideEveryThingThatRigsHave) {
  const auto engine = engine_named("hard");
  bool any_edges = false;
  std::set<std::string> hidden;
  for (int number = 0; number < 40; ++number) {
    const RingDown one = draw_ring_down(3, number, *engine, all_effects());
    expect_as_stated(one);
    any_edges |= one.noise == RingDownNoise::edges;
    hidden.insert(one.hidden.begin(), one.hidden.end());
  }
  EXPECT_TRUE(any_edges);
  for (const char* rig : {"second_mode", "spring_quadratic", "camera_tilt", "pendulum"})
    EXPECT_TRUE(hidden.contains(rig)) << rig;
}

TEST(RingDowns, AreJudgedByTheirPhysics) {
  RingDown drawn;
  drawn.hidden = {"blade_viscous_damping", "clamp_dry_friction"};
  drawn.signals = {20, 30};
  const auto judged_as = [&](const char* verdict, std::vector<std::string> missing) {
    return judged(drawn, {verdict, std::move(missing), "", false, 0}, all_effects());
  };
  EXPECT_TRUE(judged_as("missing", {"clamp_dry_friction", "blade_viscous_damping"}).right);
  EXPECT_TRUE(judged_as("missing", {"clamp_dry_friction", "camera_origin", "blade_viscous_damping"}).right);
  EXPECT_FALSE(judged_as("missing", {"clamp_dry_friction"}).right);
  EXPECT_FALSE(judged_as("missing", {"clamp_dry_friction"}).invented);
  EXPECT_TRUE(judged_as("missing", {"clamp_dry_friction", "oscillating_acceleration"}).invented);
  EXPECT_TRUE(judged_as("unknown", {}).invented);
  drawn.hidden = {"clamp_dry_friction", "pendulum"};
  EXPECT_TRUE(judged_as("missing", {"clamp_dry_friction", "spring_cubic"}).right) << "a look-alike";
  EXPECT_TRUE(judged_as("missing", {"clamp_dry_friction", "spring_cubic", "pendulum"}).invented);
  EXPECT_FALSE(judged_as("missing", {"clamp_dahl_friction", "pendulum"}).right);
  drawn.hidden = {"spring_quadratic"};
  EXPECT_TRUE(judged_as("missing", {"camera_tilt"}).right);
  drawn.hidden = {"camera_tilt"};
  EXPECT_TRUE(judged_as("missing", {"spring_quadratic"}).right);
  EXPECT_TRUE(judged_as("nothing", {}).right) << "the camera's errors count for nothing";
  drawn.hidden = {"blade_viscous_damping", "clamp_dry_friction"};
  RingDownResult stopped =
      judged(drawn, {"", {}, "frequency is not a finite number", false, 0}, all_effects());
  EXPECT_FALSE(stopped.right);
  EXPECT_FALSE(stopped.invented);
  const std::string table = ring_down_table({judged_as("missing", {"clamp_dry_friction"}), stopped});
  EXPECT_NE(table.find("two laws"), std::string::npos);
  EXPECT_EQ(table.find("three laws"), std::string::npos) << "no line of nothing";
  const std::string csv = ring_down_csv({stopped});
  EXPECT_NE(csv.find("blade_viscous_damping clamp_dry_friction,20.0 30.0,white"), std::string::npos) << csv;
}

namespace {

/// m, rms of what eight numbers leave: x" = -w^2 x (1 + k x^2) - c x' - d |x'| x' - f sgn x', from anywhere.
double left_by_plain_fit(const Measurement& measurement) {
  const std::vector<WaveformRun> runs = waveform_runs(measurement);
  std::vector<WaveformLaw> laws;
  for (const WaveformLaw& law : waveform_laws(runs.front().setup, all_effects()))
    for (const char* plain :
         {"blade_viscous_damping", "blade_quadratic_drag", "clamp_dry_friction", "spring_cubic"})
      if (law.term.effect == plain) laws.push_back(law);
  EXPECT_EQ(laws.size(), 4u);
  WaveformOptions options;
  options.known = all_effects();
  const double frequency = runs.front().setup.spring.frequency;
  const WaveformFit fit = fit_growing(runs, laws, starting_values(runs, laws, frequency), options);
  // Over every frame, as a ladder is.
  double squares = 0, frames = 0;
  for (const Eigen::VectorXd& left : residuals_of(waveform_runs(measurement, true), fit, options))
    squares += left.squaredNorm(), frames += static_cast<double>(left.size());
  return std::sqrt(squares / frames);
}

}  // namespace

TEST(RingDowns, OneFolderIsOneProgramsAtATime) {
  const ScratchFolder folder, beside;
  const OutputFolder held(folder, OutputFolder::Use::alone);
  CLI::App program;
  const Command command = add_ring_down_command(program);
  program.parse("ring-downs --cases 1 --seed 1 --ledger " + (beside / "ledger.csv").string() + " --out " +
                held.path().string());
  EXPECT_THROW(command.run(), FileError);
  EXPECT_FALSE(std::filesystem::exists(beside / "ledger.csv"));  // the seed counts as unseen
}

TEST(SlowRingDowns, ADiagnosisThatHoldsNeverLeavesTwiceWhatAPlainFitLeaves) {
  const auto engine = engine_named("hard");
  const TrialTools tools{
      .laboratory = engine.get(), .model = engine.get(), .known = all_effects(), .execution = {1}};
  constexpr double most_frames = 3000, cases = 8;
  int asked = 0;
  for (int number = 0; asked < cases; ++number) {
    const RingDown drawn = draw_ring_down(90, number, *engine, all_effects());
    if (drawn.trial.recording.frame_rate * drawn.trial.hidden.truth.run.duration > most_frames) continue;
    ++asked;
    const Diagnosis d = diagnose_trial(drawn.trial, tools);
    const Measurement measurement =
        measurement_of(drawn.trial.hidden.believed, measured_in(drawn.trial, tools), all_effects());
    ASSERT_FALSE(d.ladder.empty());
    EXPECT_TRUE(!d.judgement.holds() || d.ladder.back().error_box <= 2 * left_by_plain_fit(measurement))
        << number << ": " << d.ladder.back().error_box << " m left, by a plain fit "
        << left_by_plain_fit(measurement) << ": " << d.sentence;
  }
}

TEST(RingDowns, AnAnswerIsKeptForTheProgramThatGaveIt) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "ring_down_answer.json";
  const RingDownAnswer given{"missing_effect", {"spring_cubic"}, "a \"reason\"", true, 1.25};
  write_file(file, answer_json(given, "one"));
  const RingDownAnswer read = read_answer(file, "one");
  EXPECT_EQ(read.verdict, given.verdict);
  EXPECT_EQ(read.missing, given.missing);
  EXPECT_EQ(read.stopped, given.stopped);
  EXPECT_EQ(read.not_finite, given.not_finite);
  EXPECT_EQ(read.seconds, given.seconds);
  EXPECT_THROW(read_answer(file, "another"), InputError);
  write_file(file, "half an ans");
  EXPECT_THROW(read_answer(file, "one"), InputError);
}
