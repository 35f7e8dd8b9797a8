// SPDX-License-Identifier: MIT
// A stand-in for the engine whose motion is known: x = Delta0 cos(2 pi f t) exp(-(1 - e_pp e_pw) t), with a
// little chaos; the grain mass does nothing at all.
#include "fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects.hpp"
#include "engines.hpp"
#include "free_parameters.hpp"
#include "measurements.hpp"
#include "random.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

class StandIn final : public Engine {
 public:
  std::string_view name() const override { return "stand-in"; }
  Capability can_model(const EffectRecord&) const override { return {Fidelity::exact, ""}; }
  Trajectory run(const shakedown::Setup& setup, const RunOptions& options) const override {
    Random random(setup.run.seed, static_cast<std::uint64_t>(options.run), Stream::velocities);
    const double chaos = 2e-4 * random.normal(), late = 4e-4 * random.normal();
    const double rate = 0.6 * (1 - setup.restitution.grain_grain * setup.restitution.grain_wall);
    Trajectory t;
    for (int i = 0; i <= static_cast<int>(setup.run.duration * setup.run.sample_rate); ++i) {
      const double time = i / setup.run.sample_rate,
                   swing = std::cos(2 * std::numbers::pi * setup.spring.frequency * time);
      t.time.push_back(time);
      t.x_box.push_back((0.1075 * std::exp(-rate * time) + chaos + late * time / 8) * swing);
      t.x_com.push_back(0.9 * t.x_box.back());
      t.v_box.push_back(0);
      t.total_energy.push_back(1);
    }
    t.initial_energy = 1;
    return t;
  }
};

shakedown::Setup believed() {
  shakedown::Setup setup;
  setup.restitution = {0.85, 0.76};
  setup.spring.frequency = 1.2;
  return setup;
}

Experiment measured(shakedown::Setup truth = {}) {
  const StandIn engine;
  truth.run.duration = 8;
  return make_measurements(truth, runs_of_lengths({0.040, 0.065}), {},
                           {&engine, all_effects(), 3, 1, nullptr});
}

Fit fitted(const std::string& free, std::vector<std::string> on = {"L040"}, double frequency = 1.2) {
  shakedown::Setup start = believed();
  start.spring.frequency = frequency;
  FitOptions options;
  options.on = std::move(on);
  options.count = 64;
  options.execution.threads = 1;
  options.known = all_effects();
  return fit_parameters(start, measurement_of(start, measured(), all_effects()),
                        free_parameters(free, start, all_effects()), StandIn(), options);
}

}  // namespace

TEST(Fit, FromAFrequencyThatTurnsThePhaseRoundToTheTruth) {
  const Fit fit = fitted("restitution.grain_grain,spring.frequency");
  ASSERT_EQ(fit.parameters.size(), 2u);
  for (const auto& [parameter, truth] :
       {std::pair(fit.parameters[0], 0.75), std::pair(fit.parameters[1], 1.23)}) {
    EXPECT_LE(parameter.low, truth) << parameter.key;
    EXPECT_GE(parameter.high, truth) << parameter.key;
    EXPECT_TRUE(parameter.told) << parameter.remark;
  }
  EXPECT_LT(fit.parameters[0].high - fit.parameters[0].low, 0.05);
  EXPECT_LT(fit.parameters[1].high - fit.parameters[1].low, 0.01);
  ASSERT_EQ(fit.left_out.size(), 1u);
  EXPECT_EQ(fit.left_out[0].run, "L065");
  EXPECT_LT(fit.left_out[0].error_box, 2 * fit.left_out[0].floor_box);
  EXPECT_GT(fit.p_value, 0.01);
  EXPECT_NE(fit_json(fit).find("\"runs_left_out\""), std::string::npos);
  EXPECT_NE(fit_text(fit).find("runs foretold"), std::string::npos);
}

// Such a camera moves the box by 5 mm where its noise is 0.2 mm: `compare` and `diagnose` allow for it, and a
// fit that did not was rejected with 14 times the misfit of its own runs (a phone's film, nothing hidden).
TEST(Fit, ThroughALensAShutterAndAScaleThatAreKnownToTheirErrors) {
  shakedown::Setup truth;
  set_number(truth, "camera_lens.distortion", 0.008, all_effects());
  set_number(truth, "camera_shutter.time", 0.004, all_effects());
  set_number(truth, "camera_scale.scale", -0.004, all_effects());
  const shakedown::Setup start = believed();
  FitOptions options;
  options.on = {"L040"};
  options.count = 64;
  options.execution.threads = 1;
  options.known = all_effects();
  const Fit fit = fit_parameters(
      start, measurement_of(start, measured(truth), all_effects()),
      free_parameters("restitution.grain_grain,spring.frequency", start, all_effects()), StandIn(), options);
  EXPECT_GT(fit.p_value, 0.01);
  EXPECT_LT(fit.scatter, 1.5);
  ASSERT_EQ(fit.parameters.size(), 2u) << "the camera's numbers were not asked for";
  EXPECT_EQ(fit.correlation.rows(), 2);
  for (const auto& [parameter, value] :
       {std::pair(fit.parameters[0], 0.75), std::pair(fit.parameters[1], 1.23)}) {
    EXPECT_LE(parameter.low, value) << parameter.key;
    EXPECT_GE(parameter.high, value) << parameter.key;
  }
  const auto lens = std::find_if(fit.beside.begin(), fit.beside.end(), [](const NuisanceFound& freed) {
    return freed.name == "camera_lens.distortion";
  });
  ASSERT_NE(lens, fit.beside.end());
  EXPECT_LT(std::abs(lens->value - 0.008), 3 * lens->error);
  EXPECT_NE(fit_text(fit).find("camera_lens.distortion"), std::string::npos);
  EXPECT_NE(fit_json(fit).find("\"camera\""), std::string::npos);
  ASSERT_EQ(fit.left_out.size(), 1u);
  EXPECT_LT(fit.left_out[0].error_box, 2 * fit.left_out[0].floor_box) << "foretold through the same camera";
}

TEST(Fit, WhatTheDataCannotTellIsSaid) {
  const Fit fit = fitted("restitution.grain_grain,grains.diameter", {"L040"}, 1.23);
  EXPECT_TRUE(fit.parameters[0].told);
  EXPECT_FALSE(fit.parameters[1].told);
  EXPECT_NE(fit.parameters[1].remark.find("do not tell"), std::string::npos) << fit.parameters[1].remark;
}

TEST(Fit, WhatTheDataCannotTellIsKnownAsWellAsIsBelieved) {
  const shakedown::Setup start = believed();
  std::vector<Knob> knobs =
      free_parameters("restitution.grain_grain,spring.frequency,grains.diameter", start, all_effects());
  constexpr double known_to = 1e-4;
  knobs.back().believed = knobs.back().centre, knobs.back().believed_error = known_to;
  FitOptions options;
  options.on = {"L040"};
  options.count = 64;
  options.execution.threads = 1;
  options.known = all_effects();
  const Fit fit =
      fit_parameters(start, measurement_of(start, measured(), all_effects()), knobs, StandIn(), options);
  EXPECT_LT(fit.parameters.back().error, 2 * known_to);
  EXPECT_GT(fit.parameters.back().error, known_to / 2);
}

TEST(Fit, TwoThatOnlyTheirProductTellsAreConfounded) {
  const Fit fit = fitted("restitution.grain_grain,restitution.grain_wall", {}, 1.23);
  EXPECT_LT(fit.correlation(0, 1), -0.95);
  EXPECT_NE(fit.parameters[0].remark, "");
  EXPECT_TRUE(fit.left_out.empty());
}

TEST(Fit, BadInput) {
  EXPECT_THROW(fitted("restitution.grain_grain", {"L041"}), InputError);
  for (const char* bad :
       {"", "restitution.grain_grian", "grains.count", "restitution.grain_grain,restitution.grain_grain",
        "release.packing", "blade.length", "soft.contact_time", "hard.kick_interval"})
    EXPECT_THROW(free_parameters(bad, believed(), all_effects()), InputError) << bad;
  const std::vector<Knob> together =
      free_parameters("grain_friction.grain_grain&grain_friction.grain_wall", believed(), all_effects());
  ASSERT_EQ(together.size(), 1u);
  EXPECT_EQ(together[0].low, 0);
  // nine keys: 55 terms, and 80 simulations in a round
  EXPECT_THROW(fitted("restitution.grain_grain,restitution.grain_wall,spring.frequency,box.mass,grains.mass,"
                      "blade_viscous_damping.damping,spring_cubic.coefficient,clamp_dry_friction.force,"
                      "blade_quadratic_drag.drag"),
               InputError);
}

TEST(SlowFit, TheSoftEnginesDamperIsFittedByTheHardOne) {
  shakedown::Setup truth;
  truth.run.duration = 14;
  const std::unique_ptr<Engine> soft = engine_named("soft"), hard = engine_named("hard");
  const Experiment experiment = make_measurements(truth, runs_of_lengths({0.040, 0.085}), {},
                                                  {soft.get(), all_effects(), 5, 0, nullptr});
  shakedown::Setup start;
  start.restitution = {0.9, 0.6};
  start.spring.frequency = 1.2;
  FitOptions options;
  options.on = {"L040"};
  options.count = 96;
  options.known = all_effects();
  const Fit fit =
      fit_parameters(start, measurement_of(start, experiment, all_effects()),
                     free_parameters("restitution.grain_grain,restitution.grain_wall,spring.frequency", start,
                                     all_effects()),
                     *hard, options);
  const double truths[] = {0.75, 0.76, 1.23};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LE(fit.parameters[k].low, truths[k]) << fit_text(fit);
    EXPECT_GE(fit.parameters[k].high, truths[k]) << fit_text(fit);
  }
  EXPECT_LT(fit.left_out[0].error_box, 2 * fit.left_out[0].floor_box) << fit_text(fit);
}
