// SPDX-License-Identifier: MIT
// Boxes without grains are fitted and compared by their waveform, whatever frequency their owner believes in.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "compared.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "experiment_file.hpp"
#include "fitted.hpp"
#include "within.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

/// Two releases of an empty box: 0.02 N s/m, 8 mN and 1.26 Hz are hidden, its owner counted 1.2 Hz.
struct LeafSpring {
  fs::path folder = fs::path(TEST_DATA) / "leaf_spring";
  shakedown::Setup setup = read_setup(folder / "setup.toml", all_effects());
  Measurement measurement =
      measurement_of(setup, read_experiment(folder / "experiment.toml", all_effects()), all_effects());
  std::unique_ptr<Engine> engine = engine_named("hard");
};

TEST(SlowEmptyBoxAnswers, AFitFindsAFrequencyFivePerCentOff) {
  const LeafSpring leaf;
  FitOptions options = usual_fit_options();
  options.on = {"ring_down_1"};
  const Fit fit = fitted_and_judged(
      leaf.setup, leaf.measurement,
      {"spring.frequency,blade_viscous_damping.damping,clamp_dry_friction.force"}, *leaf.engine, options);
  ASSERT_EQ(fit.parameters.size(), 3u);
  WITHIN(fit.parameters[0].value, 1.26, 2e-5, 4.4e-6);
  // Seen: 2.0 and 2.1 standard errors off, of one noise: the two are correlated by -0.96. Of 60 other films
  // (0.02 N s/m, 8 mN, 20 s) the intervals hold 97 and 93 %.
  const auto errors_off = [](const FittedParameter& p, double truth) {
    return std::abs(p.value - truth) / ((p.high - p.low) / (2 * 1.96));
  };
  EXPECT_LT(errors_off(fit.parameters[1], 0.02), 3.5);
  EXPECT_LT(errors_off(fit.parameters[2], 8e-3), 3.5);
  EXPECT_TRUE(fit.judgement.holds()) << fit.judgement.reason;
  ASSERT_EQ(fit.left_out.size(), 1u);
  EXPECT_LT(fit.left_out.front().error_box, 1.5 * fit.left_out.front().floor_box);
}

TEST(SlowEmptyBoxAnswers, WhatWasFittedHoldsInAComparisonAndWhatWasGivenDoesNot) {
  const LeafSpring leaf;
  const Compared given = compared_with(leaf.setup, leaf.measurement, *leaf.engine, {});
  EXPECT_EQ(given.judgement.standing, Standing::fails);
  shakedown::Setup right = leaf.setup;
  set_number(right, "spring.frequency", 1.26, all_effects());
  set_number(right, "blade_viscous_damping.damping", 0.02, all_effects());
  set_number(right, "clamp_dry_friction.force", 8e-3, all_effects());
  const Compared compared =
      compared_with(right, with_setup(leaf.measurement, right, all_effects()), *leaf.engine, {});
  EXPECT_TRUE(compared.judgement.holds()) << compared.judgement.reason;
  ASSERT_FALSE(compared.decays.empty());
  WITHIN(compared.decays.front().frequency.model, 1.26, 5e-4, 2.6e-5);
  EXPECT_NE(compared_json(compared).find("its waveform is judged"), std::string::npos);
}

}  // namespace
