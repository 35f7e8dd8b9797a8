// SPDX-License-Identifier: MIT
// Recordings of boxes without grains as real rigs give them: a second swing, a camera from aside, beats.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "random.hpp"
#include "setup_file.hpp"
#include "swing_motion.hpp"
#include "waveform_search.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

shakedown::Setup empty_box() {
  shakedown::Setup setup;
  setup.grains.count = 0;
  return setup;
}

/// The truth as seen from somewhere in its motion on; `also`: added to the positions.
template <class Also>
Measurement filmed(const shakedown::Setup& truth, double noise, const Also& also) {
  constexpr double rate = 50, duration = 25;
  Random random(7, 0, Stream::camera);
  Experiment experiment;
  MeasuredRun& run = experiment.runs.emplace_back();
  run.name = "empty";
  run.box_length = truth.box.length;
  run.frame_rate = rate;
  for (int i = 0; i < static_cast<int>(rate * duration); ++i) run.time.push_back(i / rate);
  run.x_box = swing_of(physics_of(truth), {0.08, 0.3}, run.time, 1);
  for (std::size_t i = 0; i < run.time.size(); ++i) {
    double& x = run.x_box[i];
    x += also(run.time[i], x) + 0.012 + noise * random.normal();
  }
  return measurement_of({empty_box()}, std::move(experiment));
}

Diagnosis diagnosed(const Measurement& measurement) {
  DiagnoseOptions options;
  options.known = all_effects();
  return diagnose(empty_box(), measurement, *engine_named("hard"), options);
}

bool names(const Diagnosis& d, const std::string& effect) {
  return std::find(d.missing.begin(), d.missing.end(), effect) != d.missing.end();
}

double value_of(const Diagnosis& d, const std::string& key) {
  for (const DiagnosedParameter& p : d.parameters)
    if (p.name == key) return p.value;
  return std::nan("");
}

TEST(SlowWaveformSearch, TellsASecondSwingThatDiesAwayBesideQuadraticDrag) {
  shakedown::Setup truth = empty_box();
  set_number(truth, "blade_quadratic_drag.drag", 0.1, all_effects());
  const Diagnosis d = diagnosed(filmed(truth, 1e-4, [](double t, double) {
    return 3e-3 * std::exp(-0.1 * t) * std::sin(2 * std::numbers::pi * 1.9 * t + 0.4);
  }));
  EXPECT_EQ(d.verdict, Verdict::missing) << d.sentence;
  EXPECT_EQ(d.judgement.standing, Standing::holds) << d.judgement.reason;
  ASSERT_EQ(d.missing, (std::vector<std::string>{"blade_quadratic_drag", "second_mode"})) << d.sentence;
  WITHIN(value_of(d, "blade_quadratic_drag.drag"), 0.1, 2e-3, 1e-4);
  WITHIN(value_of(d, "second_mode.frequency"), 1.9, 5e-4, 2.6e-5);
  WITHIN(value_of(d, "second_mode.rate"), 0.1, 1e-3, 8.9e-5);
}

TEST(SlowWaveformSearch, AnEvenHarmonicIsNoAcceleration) {
  shakedown::Setup truth = empty_box();
  set_number(truth, "blade_viscous_damping.damping", 0.03, all_effects());
  const Diagnosis d = diagnosed(filmed(truth, 1e-4, [](double, double x) { return 0.2 * x * x; }));
  EXPECT_TRUE(names(d, "blade_viscous_damping")) << d.sentence;
  EXPECT_TRUE(names(d, "camera_tilt")) << d.sentence;
  EXPECT_FALSE(names(d, "oscillating_acceleration") || names(d, "second_mode")) << d.sentence;
  EXPECT_EQ(d.judgement.standing, Standing::holds) << d.judgement.reason;
  WITHIN(value_of(d, "blade_viscous_damping.damping"), 0.03, 5e-5, 2.6e-6);
}

// Two pendula that pass their energy to and fro: no law of the list does this.
TEST(SlowWaveformSearch, BeatsNeverHold) {
  const shakedown::Setup truth = empty_box();
  const Diagnosis d = diagnosed(filmed(truth, 1e-4, [&](double t, double) {
    return 0.06 * std::sin(2 * std::numbers::pi * 1.06 * truth.spring.frequency * t);
  }));
  EXPECT_TRUE(d.verdict == Verdict::unknown || d.judgement.standing == Standing::fails) << d.sentence;
}

// The strongest of a wander lies at its slow end and stands out from nothing.
TEST(WaveformSearch, ALineStandsOutFromTheNoiseAroundIt) {
  Random random(3, 0, Stream::camera);
  std::vector<PowerAt> spectrum;
  for (int i = 1; i <= 300; ++i)
    spectrum.push_back({0.01 * i, -std::log(1 - random.uniform()) * (1 + 1e3 / (1 + std::pow(i / 30.0, 2)))});
  EXPECT_EQ(line_in(spectrum), 0);
  spectrum[150].power = 40;
  std::vector<PowerAt> white = spectrum;
  for (PowerAt& one : white) one.power = one.frequency == spectrum[150].frequency ? 40 : 1;
  EXPECT_EQ(line_in(white), spectrum[150].frequency);
  EXPECT_EQ(line_in({}), 0);
}

TEST(WaveformSearch, APriorNeverLetsADampingPush) {
  WaveformFit fit;
  for (const WaveformLaw& law : waveform_laws(empty_box(), all_effects()))
    if (law.term.effect == "blade_viscous_damping") fit.laws = {law};
  ASSERT_EQ(fit.laws.size(), 1u);
  fit.residual.resize(1);
  fit.value = Eigen::VectorXd::Constant(5, 0.05);
  fit.covariance = 1e-6 * Eigen::MatrixXd::Identity(5, 5);
  EXPECT_TRUE(std::isfinite(log_prior_odds(fit, 10, 1)));
  fit.value[4] = -0.05;
  EXPECT_FALSE(std::isfinite(log_prior_odds(fit, 10, 1)));
}

}  // namespace
