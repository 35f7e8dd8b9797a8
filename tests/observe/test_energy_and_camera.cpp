// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "camera.hpp"
#include "observables.hpp"
#include "sampled.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(Energy, TimesToFractionsAreInterpolated) {
  Trajectory trajectory;
  trajectory.initial_energy = 2;
  for (int k = 0; k <= 10; ++k) {
    trajectory.time.push_back(k);
    trajectory.total_energy.push_back(2 * (1 - 0.096 * k));  // down to 4 %
  }
  WITHIN(seconds_to_energy_fraction(trajectory, 0.5), 0.5 / 0.096, 2e-14, 1.2e-15);
  WITHIN(seconds_to_energy_fraction(trajectory, 0.05), 0.95 / 0.096, 4e-14, 2.2e-15);
  EXPECT_TRUE(std::isnan(seconds_to_energy_fraction(trajectory, 0.01)));
}

TEST(Energy, SharesAreOfTheInitialEnergy) {
  Trajectory trajectory;
  trajectory.initial_energy = 0.16;
  trajectory.ledger.contact_loss = {0.08, 0.04, 0.02};
  trajectory.ledger.effect_loss = {-0.016};
  const Observables seen = observe(trajectory, shakedown::Setup{});
  EXPECT_DOUBLE_EQ(seen.energy_loss[0], 0.5);
  EXPECT_DOUBLE_EQ(seen.energy_loss[2], 0.125);
  EXPECT_DOUBLE_EQ(seen.effect_loss[0], -0.1);
}

TEST(CameraOptics, NeutralCameraSeesTheTruth) {
  Trajectory truth = sampled(1, 50, [](double t) { return 0.1 - 0.2 * t; }, {});
  for (std::size_t i = 0; i < truth.x_com.size(); ++i) truth.x_com[i] = 0.13 - 0.3 * truth.time[i];
  const Recording seen = recorded_by(Camera{}, truth);
  EXPECT_EQ(seen.time, truth.time);
  EXPECT_EQ(seen.x_box, truth.x_box);
  for (std::size_t i = 0; i < truth.x_com.size(); ++i) WITHIN(seen.x_com[i], truth.x_com[i], 5e-16, 2.8e-17);
}

TEST(CameraOptics, EachErrorActsAsStated) {
  Trajectory truth;
  truth.time = {2};
  truth.x_box = {0.1};
  truth.x_com = {0.12};
  EXPECT_DOUBLE_EQ(recorded_by(Camera{.centre_bias = 0.25}, truth).x_com[0], 0.115);
  EXPECT_DOUBLE_EQ(recorded_by(Camera{.scale = 0.01}, truth).x_box[0], 0.101);
  EXPECT_DOUBLE_EQ(recorded_by(Camera{.scale = 0.01}, truth).x_com[0], 0.1212);
  EXPECT_DOUBLE_EQ(recorded_by(Camera{.time_offset = 0.004}, truth).time[0], 2.004);
  EXPECT_DOUBLE_EQ(recorded_by(Camera{.drift = 1e-3}, truth).x_box[0], 0.102);
  EXPECT_DOUBLE_EQ(recorded_by(Camera{.arc_length = 0.59}, truth).x_com[0],
                   0.1 + 0.02 * std::cos(0.15 / 0.59));
}
