// SPDX-License-Identifier: MIT
// Which experiment would tell two models apart.
#include <gtest/gtest.h>

#include <algorithm>

#include "effects.hpp"
#include "engines.hpp"
#include "hidden_measurements.hpp"
#include "next_experiment.hpp"
#include "parameter_knobs.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// sd of the restitutions and the frequency (Hz), as one experiment leaves them.
FittedModel known_to(const shakedown::Setup& setup, double restitution, double frequency) {
  const Eigen::Vector3d error(restitution, restitution, frequency);
  return {setup, free_parameters(setup), error.cwiseAbs2().asDiagonal()};
}

double told_apart(const shakedown::Setup& one, const shakedown::Setup& other, const Design& design) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const Workshop workshop{engine.get(), all_effects(), {2}};
  return advise({design}, known_to(one, 0.02, 2e-4), other, {2e-4, 5e-4, 64, 1}, workshop).front().sigmas;
}

shakedown::Setup with(const char* key, double value) {
  shakedown::Setup setup = believed();
  set_number(setup, key, value, all_effects());
  return setup;
}

TEST(SlowNextExperiment, AStrongerEffectIsToldMoreEasily) {
  const auto sigmas = [](double exponent) {
    return told_apart(with("velocity_dependent_restitution.exponent", exponent), believed(),
                      {37, 0.104, 0.1075});
  };
  EXPECT_EQ(sigmas(0), 0);
  const double weak = sigmas(0.05);
  EXPECT_GT(weak, 2);                                // seen: 4.4
  WITHIN(sigmas(0.2) / (4 * weak), 1, 0.25, 0.033);  // linear in the strength
}

// A clock that is late by t is a push of t Omega^2 Delta0 (the grains lie a little off the wall), at that
// release and at no other.
TEST(SlowNextExperiment, ALateClockIsToldFromAPushByAnotherRelease) {
  const shakedown::Setup plain = believed();
  const double omega = 2 * std::numbers::pi * plain.spring.frequency, late = 0.002;
  const shakedown::Setup clock = with("camera_time_offset.offset", late),
                         push = with("initial_box_velocity.velocity",
                                     late * omega * omega * plain.release.displacement);
  const double same = told_apart(clock, push, {37, 0.104, 0.1075}),
               half = told_apart(clock, push, {37, 0.104, 0.05375});
  EXPECT_LT(same, 1.5);  // seen: 0.2
  EXPECT_GT(half, 6);    // seen: 12.7
}

TEST(NextExperiment, WhatWasMeasuredIsNotProposedAgain) {
  const std::vector<Design> all = possible_designs(believed(), {});
  MeasuredFeatures measured;
  measured.setup = in_design(believed(), all.front());
  const std::vector<Design> left = possible_designs(believed(), {measured});
  ASSERT_EQ(left.size(), all.size() - 1);
  EXPECT_EQ(left.front().words(), all[1].words());
}

}  // namespace
