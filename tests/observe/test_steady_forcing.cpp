// SPDX-License-Identifier: MIT
// The forced box without grains has closed forms: amplitude a M / sqrt((k - M w^2)^2 + (c w)^2), phase and
// loss factor c w / k.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects.hpp"
#include "engines.hpp"
#include "run_numbers.hpp"
#include "setup_file.hpp"
#include "steady_forcing.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

shakedown::Setup forced(double frequency, double damping) {
  return parse_setup(
      "[grains]\ncount = 0\n[release]\ndisplacement = \"1 mm\"\n[[effect]]\nname = "
      "\"oscillating_acceleration\"\n"
      "amplitude = [\"0.5 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\nfrequency = \"" +
          std::to_string(frequency) +
          " Hz\"\nphase = \"0.7 rad\"\n[[effect]]\nname = \"blade_viscous_damping\"\ndamping = \"" +
          std::to_string(damping) + " N s/m\"\n",
      "test", all_effects());
}

}  // namespace

TEST(SteadyForcing, TheForcedDampedBox) {
  const double damping = 0.8;  // transients gone after 30 cycles
  for (const double frequency : {0.9, 1.23, 1.7}) {
    const shakedown::Setup setup = long_enough_for_forcing(forced(frequency, damping));
    EXPECT_DOUBLE_EQ(setup.run.duration, 40 / frequency);
    const SteadyState steady = steady_state(setup, engine_named("hard")->run(setup));
    const double w = 2 * std::numbers::pi * frequency, k = 0.434 * std::pow(2 * std::numbers::pi * 1.23, 2);
    const double amplitude = 0.434 * 0.5 / std::hypot(k - 0.434 * w * w, damping * w);
    WITHIN(steady.amplitude / amplitude, 1, 2e-4, 1.7e-5) << frequency;
    EXPECT_LT(steady.variation, 1e-4);
    WITHIN(steady.phase_lag, std::atan2(damping * w, k - 0.434 * w * w), 1e-5, 7.8e-7) << frequency;
    WITHIN(steady.loss_factor / (damping * w / k), 1, 6e-4, 3.3e-5) << frequency;
  }
}

TEST(SteadyForcing, WithGrainsTheLossIsThatOfTheContacts) {
  shakedown::Setup setup = parse_setup(
      "[box]\nlength = \"65 mm\"\n[[effect]]\nname = \"oscillating_acceleration\"\namplitude = [\"0.3 "
      "m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\nfrequency = \"1.05 Hz\"\n",
      "test", all_effects());
  setup = long_enough_for_forcing(setup);
  const Trajectory trajectory = engine_named("hard")->run(setup);
  const SteadyState steady = steady_state(setup, trajectory);
  const std::size_t from = static_cast<std::size_t>(std::lround(30 / 1.05 * 500));
  double lost = 0;
  for (const std::vector<double>& loss : trajectory.loss) lost += loss.back() - loss[from];
  const double stored =
      0.434 * std::pow(2 * std::numbers::pi * 1.23, 2) * steady.amplitude * steady.amplitude / 2;
  WITHIN(lost / 10 / (2 * std::numbers::pi * stored) / steady.loss_factor, 1, 5e-3, 2.6e-4);
}

TEST(SteadyForcing, OnlyOneForcingAlongTheAxisIsSteady) {
  EXPECT_FALSE(steady_forcing_of(shakedown::Setup{}));
  shakedown::Setup setup = forced(1, 0.1);
  EXPECT_TRUE(steady_forcing_of(setup));
  setup.effects.push_back(setup.effects.front());
  EXPECT_FALSE(steady_forcing_of(setup));
}

TEST(SteadyForcing, ARunawayAtResonanceDoesNotRattle) {
  shakedown::Setup setup = parse_setup(
      "[box]\nlength = \"65 mm\"\n[run]\nduration = \"12 s\"\n[[effect]]\nname = "
      "\"oscillating_acceleration\"\namplitude = [\"1 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\nfrequency = \"1.05 "
      "Hz\"\n",
      "test", all_effects());
  const Trajectory trajectory = engine_named("hard")->run(setup);
  // 400 000 seen; 1 280 000 with limits that know nothing of the swing
  EXPECT_LT(trajectory.events, 800'000);
  // 607.1 +- 0.5 mm with those.
  WITHIN(-*std::min_element(trajectory.x_box.begin(), trajectory.x_box.end()), 0.6071, 3e-3, 2.2e-4);
}

// x = B k / (k - M w^2 + i c w): the loss factor is that of the same damper shaken as a whole.
TEST(SteadyForcing, TheBoxWhoseBaseMoves) {
  const double damping = 0.8, mass = 0.434, k = mass * std::pow(2 * std::numbers::pi * 1.23, 2), base = 2e-3;
  for (const double frequency : {0.9, 1.23, 1.7}) {
    const double w = 2 * std::numbers::pi * frequency, phase = 0.4;
    std::string samples;
    for (double t = 0; t <= 40 / frequency; t += 0.005)
      samples += std::to_string(t) + " " + std::to_string(base * std::sin(w * t + phase)) + " ";
    shakedown::Setup setup = parse_setup(
        "[grains]\ncount = 0\n[release]\ndisplacement = \"1 mm\"\n[[effect]]\nname = "
        "\"base_motion\"\nsamples = "
        "\"" +
            samples + "\"\n[[effect]]\nname = \"blade_viscous_damping\"\ndamping = \"0.8 N s/m\"\n",
        "test", all_effects());
    setup.run.duration = 39.9 / frequency;
    const std::optional<SteadyState> steady = steady_state_if_any(setup, engine_named("hard")->run(setup));
    ASSERT_TRUE(steady) << frequency;
    const double amplitude = base * k / std::hypot(k - mass * w * w, damping * w);
    WITHIN(steady->amplitude / amplitude, 1, 4e-4, 2e-5) << frequency;  // samples to 1 um
    WITHIN(steady->phase_lag, std::atan2(damping * w, k - mass * w * w), 2e-3, 1.3e-4) << frequency;
    WITHIN(steady->loss_factor / (damping * w / k), 1, 1e-2, 5e-4) << frequency;
    EXPECT_TRUE(std::isnan(steady->effective_mass));
  }
}

TEST(SteadyForcing, ABaseThatHaltsHasNoSteadyState) {
  std::string samples;
  for (double t = 0; t <= 20; t += 0.02)
    samples += std::to_string(t) + " " + std::to_string(t < 12 ? 2e-3 * std::sin(6 * t) : 0.0) + " ";
  shakedown::Setup setup =
      parse_setup("[grains]\ncount = 0\n[[effect]]\nname = \"base_motion\"\nsamples = \"" + samples + "\"\n",
                  "test", all_effects());
  setup.run.duration = 20;
  EXPECT_FALSE(steady_state_if_any(setup, engine_named("hard")->run(setup)));
}

// A grain with a tenth of a millimetre of room rides along, one that has left the wall for good floats.
TEST(SteadyForcing, GrainsThatRideAlongWeighAllTheirMass) {
  shakedown::Setup setup = parse_setup(
      "[grains]\ncount = 1\n[box]\nlength = \"10.1 mm\"\n[release]\ndisplacement = \"1 "
      "mm\"\n[[effect]]\nname = "
      "\"oscillating_acceleration\"\namplitude = [\"0.5 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\nfrequency = \"1 "
      "Hz\"\n[[effect]]\nname = \"blade_viscous_damping\"\ndamping = \"0.8 N s/m\"\n",
      "test", all_effects());
  setup = long_enough_for_forcing(setup);
  const SteadyState riding = steady_state(setup, engine_named("hard")->run(setup));
  WITHIN(riding.effective_mass / setup.grains.mass, 1, 0.02, 1.8e-3);
  setup.box.length = 10;  // m; it never reaches the other wall
  const SteadyState floating = steady_state(setup, engine_named("hard")->run(setup));
  WITHIN(floating.effective_mass / setup.grains.mass, 0, 2e-14, 1.4e-15);
}
