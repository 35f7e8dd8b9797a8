// SPDX-License-Identifier: MIT
// The motion of a box alone against closed forms and against the engine, and its fit to frames.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "effects.hpp"
#include "engines.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"
#include "swing_motion.hpp"
#include "waveform.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

shakedown::Setup empty_box() {
  shakedown::Setup setup;
  setup.grains.count = 0;
  setup.run.duration = 12;
  setup.run.sample_rate = 200;
  return setup;
}

double farthest_from_engine(const shakedown::Setup& setup) {
  const Trajectory by_engine = engine_named("hard")->run(setup, {});
  const double release = setup.release.displacement;
  const std::vector<double> x = swing_of(physics_of(setup), {release, 0}, by_engine.time, 10 * release);
  EXPECT_EQ(x.size(), by_engine.time.size());
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - by_engine.x_box[i]));
  return most / release;
}

TEST(SwingMotion, IsACosineWithoutForces) {
  const shakedown::Setup setup = empty_box();
  std::vector<double> time;
  for (int i = 0; i < 3000; ++i) time.push_back(i * 4e-3);
  const std::vector<double> x = swing_of(physics_of(setup), {0.1, 0}, time, 1);
  double most = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    most = std::max(most,
                    std::abs(x[i] - 0.1 * std::cos(2 * std::numbers::pi * setup.spring.frequency * time[i])));
  EXPECT_LT(most, 1e-4 * 0.1);
}

// The phase is off by some 1e-5 after fifteen periods.
TEST(SwingMotion, IsThatOfTheEngineUnderEveryLaw) {
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, double>>{{"blade_viscous_damping.damping", 0.05},
                                                   {"blade_quadratic_drag.drag", 0.2},
                                                   {"clamp_dry_friction.force", 0.05},
                                                   {"clamp_dahl_friction.force", 0.05},
                                                   {"spring_cubic.coefficient", -0.1},
                                                   {"spring_quadratic.coefficient", 0.05},
                                                   {"pendulum.length", 0.1},
                                                   {"second_mode.amplitude", 0.2}}) {
    shakedown::Setup setup = empty_box();
    set_number(setup, key, value, all_effects());
    EXPECT_LT(farthest_from_engine(setup), 3e-4) << key;
  }
}

TEST(SwingMotion, StaysWhereFrictionHoldsIt) {
  shakedown::Setup setup = empty_box();
  set_number(setup, "clamp_dry_friction.force", 1, all_effects());
  const std::vector<double> x = swing_of(physics_of(setup), {0.1, 0}, {0, 5, 10, 11, 12}, 1);
  ASSERT_EQ(x.size(), 5u);
  EXPECT_EQ(x[3], x[4]);
  EXPECT_GT(std::abs(x[4]), 1e-4);
}

TEST(SwingMotion, IsEmptyWhereTheBoxRunsAway) {
  shakedown::Setup setup = empty_box();
  set_number(setup, "spring_cubic.coefficient", -0.5, all_effects());
  EXPECT_TRUE(swing_of(physics_of(setup), {0.3, 0}, {0, 1, 2, 3}, 1).empty());
}

// An encoder writes many rows while the box is fast and few where it turns: a mean over as many rows there
// would lose the turn.
TEST(Waveform, FramesOfAnUnevenClockAreAveragedOverShortTimesOnly) {
  const shakedown::Setup setup = empty_box();
  const double omega = 2 * std::numbers::pi * setup.spring.frequency, amplitude = 0.1, edge = 0.1e-3;
  Experiment experiment;
  MeasuredRun& run = experiment.runs.emplace_back();
  run.name = "edges";
  run.box_length = setup.box.length;
  const int edges = static_cast<int>(std::floor(amplitude / edge)) - 1;
  for (int half = 0; half < 20; ++half)
    for (int k = -edges; k <= edges; ++k) {
      run.x_box.push_back((half % 2 == 0 ? -k : k) * edge);
      const double phase = std::acos(run.x_box.back() / amplitude);
      run.time.push_back(
          (half % 2 == 0 ? half * std::numbers::pi + phase : (half + 1) * std::numbers::pi - phase) / omega);
    }
  const std::vector<WaveformRun> runs = waveform_runs(measurement_of({setup}, std::move(experiment)));
  ASSERT_EQ(runs.size(), 1u);
  const WaveformRun& made = runs[0];
  EXPECT_LT(made.time.size(), 2000u) << "they are averaged";
  double most = 0;
  for (std::size_t i = 0; i < made.time.size(); ++i)
    most = std::max(most, std::abs(made.x[i] - amplitude * std::cos(omega * made.time[i])));
  // The variance of time in a window of 1/48 of a period, (T/48)^2/12, is seen as 7e-4 of the amplitude; rows
  // at the two ends of a window alone would give three times that.
  EXPECT_LT(most, 2.1e-3 * amplitude);
}

TEST(Waveform, EightNumbersComeBack) {
  shakedown::Setup truth = empty_box();
  truth.run.duration = 20;
  set_number(truth, "blade_quadratic_drag.drag", 0.1, all_effects());
  set_number(truth, "spring_cubic.coefficient", 0.03, all_effects());
  WaveformRun run{"a", empty_box(), {}, {}, 1e-4, 1e-4, truth.release.displacement};
  for (int i = 0; i < 2000; ++i) run.time.push_back(i * 0.01);
  run.x = swing_of(physics_of(truth), {truth.release.displacement, 0.05}, run.time, 1);
  for (double& x : run.x) x += 0.01;
  std::vector<WaveformLaw> laws;
  for (const MomentumTerm& term : momentum_terms(empty_box(), all_effects()))
    if (term.effect == "blade_quadratic_drag" || term.effect == "spring_cubic") laws.push_back({term});
  ASSERT_EQ(laws.size(), 2u);
  WaveformOptions options;
  options.known = all_effects();
  const WaveformFit fit =
      fit_growing({run}, laws, starting_values({run}, laws, 1.01 * truth.spring.frequency), options);
  ASSERT_TRUE(fit.possible);
  EXPECT_LT(fit.rms(), 1e-7);
  // What is left is where the steps end.
  WITHIN(fit.frequency(), truth.spring.frequency, 1e-11, 5.7e-13);
  WITHIN(fit.value[2], 0.01, 1e-11, 5.7e-13);
  WITHIN(fit.value[fit.first_of(0)], 0.1, 1e-11, 5.7e-13);
  WITHIN(fit.value[fit.first_of(1)], 0.03, 1e-11, 5.7e-13);
}

}  // namespace
