// SPDX-License-Identifier: MIT
// One test body a property, run on every engine.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "initial_state.hpp"
#include "random.hpp"
#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

RunOptions numbered(int run) {
  RunOptions options;
  options.run = run;
  return options;
}

Vec3 random_direction(Random& random) {
  Vec3 direction;
  for (double& component : direction) component = random.normal();
  return direction.normalized();
}

class EveryEngine : public ::testing::TestWithParam<EngineUnderTest> {
 protected:
  std::unique_ptr<Engine> engine = GetParam().make();

  shakedown::Setup short_damper(double duration = 0.3) const {
    shakedown::Setup setup;
    setup.run.duration = duration;
    setup.run.seed = 7;
    return setup;
  }

  /// Restitution of one impact of the given class at a closing speed, from the energy it took. The gap to fly
  /// through, hence the phase of first touch within a step, is random, and so is the (not whole) number of
  /// steps per contact.
  double restitution(ContactClass kind, double speed, double steps, Random& random) const {
    shakedown::Setup setup;
    setup.release.displacement = 0;
    setup.soft.steps_per_contact = steps;
    setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.1;
    const double m = setup.grains.mass, radius = setup.grains.diameter / 2;
    const double gap = (1 + random.uniform()) * speed * setup.soft.contact_time;
    double reduced_mass = m;
    std::vector<PlacedGrain> grains;
    if (kind == ContactClass::grain_grain) {
      setup.domain = Domain::closed;
      const Vec3 direction = random_direction(random);
      grains.push_back({direction * (radius + gap / 2), -direction * (speed / 2)});
      grains.push_back({-direction * (radius + gap / 2), direction * (speed / 2)});
      reduced_mass = m / 2;
    } else {
      const Vec3 direction = kind == ContactClass::end_wall ? Vec3(1, 0, 0) : Vec3(0, 0, -1);
      grains.push_back({direction * (0.05 - radius - gap), direction * speed});
      if (kind == ContactClass::end_wall) reduced_mass = m * setup.box.mass / (m + setup.box.mass);
    }
    setup.run.duration = gap / speed + 3.5 * setup.soft.contact_time;
    setup.run.sample_rate = 1 / setup.run.duration;
    const Trajectory result = run_with(*engine, setup, grains);
    EXPECT_EQ(result.collisions[static_cast<std::size_t>(kind)], 1);
    const double loss = result.ledger.contact_loss[static_cast<std::size_t>(kind)];
    return std::sqrt(1 - loss / (reduced_mass * speed * speed / 2));
  }

  double worst_restitution_error(ContactClass kind, double fewest_steps, double most_steps,
                                 int impacts) const {
    Random random(3, 0, Stream::other);
    const double wanted = kind == ContactClass::grain_grain ? 0.75 : 0.76;
    double worst = 0;
    for (const double speed : {0.01, 0.1, 1.0})
      for (int k = 0; k < impacts; ++k) {
        const double steps = fewest_steps + (most_steps - fewest_steps) * random.uniform();
        worst = std::max(worst, std::abs(restitution(kind, speed, steps, random) - wanted));
      }
    return worst;
  }
};

TEST_P(EveryEngine, BouncesWithTheRestitutionOfTheSetup) {
  for (const auto kind : {ContactClass::grain_grain, ContactClass::end_wall, ContactClass::side_wall}) {
    EXPECT_LE(worst_restitution_error(kind, 19, 20.9, 60), GetParam().restitution_error_coarse);
    EXPECT_LE(worst_restitution_error(kind, 49, 50.9, 40), GetParam().restitution_error_fine);
  }
}

TEST_P(EveryEngine, KeepsEnergyAndMomentumAccounts) {
  const Trajectory result = engine->run(short_damper(0.6));
  EXPECT_LE(result.health.ledger_error, GetParam().ledger_error);
  EXPECT_LE(result.health.momentum_error, GetParam().momentum_error);
  EXPECT_GT(result.ledger.contact_loss[0], 0.01 * result.initial_energy);
  for (std::size_t k = 0; k < result.time.size(); ++k) {
    double sum = result.total_energy[k];
    for (const auto& loss : result.loss) sum += loss[k];
    // not WITHIN: the engines promise so much
    EXPECT_NEAR(sum / result.initial_energy, 1, GetParam().ledger_error);
  }
}

TEST_P(EveryEngine, MovesAnEmptyBoxHarmonically) {
  shakedown::Setup setup = short_damper(5);
  setup.grains.count = 0;
  const Trajectory result = engine->run(setup);
  const double rate = 2 * std::numbers::pi * setup.spring.frequency;
  for (std::size_t k = 0; k < result.time.size(); ++k) {
    WITHIN(result.x_box[k], 0.1075 * std::cos(rate * result.time[k]), 9e-14, 4.6e-15);
    EXPECT_TRUE(std::isnan(result.x_com[k]));
  }
}

TEST_P(EveryEngine, StartsFromTheCommonInitialState) {
  const shakedown::Setup setup = short_damper(0.004);
  const State state = initial_state(setup, 3);
  const Trajectory result = engine->run(setup, numbered(3));
  EXPECT_EQ(result.engine, engine->name());
  EXPECT_EQ(result.x_box[0], 0.1075);
  EXPECT_EQ(result.v_box[0], 0);
  WITHIN(result.x_com[0], centre_of_mass_x(state), 5e-16, 2.8e-17);
  const double energy =
      kinetic_energy(state, setup.box.mass) + physics_of(setup).stiffness * 0.1075 * 0.1075 / 2;
  WITHIN(result.initial_energy / energy, 1, 4e-15, 2.3e-16);
}

TEST_P(EveryEngine, SamplesAtTheAskedRate) {
  shakedown::Setup setup = short_damper(0.05);
  setup.run.sample_rate = 300;
  const Trajectory result = engine->run(setup);
  ASSERT_EQ(result.time.size(), 16u);
  for (std::size_t k = 0; k < result.time.size(); ++k)
    WITHIN(result.time[k], static_cast<double>(k) / 300, 2e-16, 1.2e-17);
  EXPECT_EQ(result.x_box.size(), 16u);
  EXPECT_EQ(result.loss[2].size(), 16u);
  WITHIN(result.end_time, 0.05, 2e-16, 1.2e-17);
  EXPECT_FALSE(result.interrupted);
}

TEST_P(EveryEngine, EndsInTheStateThatItSampledLast) {
  const Trajectory result = engine->run(short_damper(0.3));
  ASSERT_EQ(result.end_state.size(), 37u);
  EXPECT_DOUBLE_EQ(result.end_state.x_box, result.x_box.back());
  EXPECT_DOUBLE_EQ(result.end_state.v_box, result.v_box.back());
  WITHIN(centre_of_mass_x(result.end_state), result.x_com.back(), 2e-16, 1.4e-17);
}

TEST_P(EveryEngine, GivesTheSameBytesInAnyNumberOfThreads) {
  const shakedown::Setup setup = short_damper(0.25);
  std::vector<Trajectory> serial, parallel(4);
  for (int run = 0; run < 4; ++run) serial.push_back(engine->run(setup, numbered(run)));
  {
    std::vector<std::jthread> threads;
    for (int run = 0; run < 4; ++run)
      threads.emplace_back(
          [&, run] { parallel[static_cast<std::size_t>(run)] = engine->run(setup, numbered(run)); });
  }
  for (std::size_t run = 0; run < 4; ++run) {
    EXPECT_EQ(serial[run].x_box, parallel[run].x_box);
    EXPECT_EQ(serial[run].total_energy, parallel[run].total_energy);
    EXPECT_EQ(serial[run].ledger.contact_loss, parallel[run].ledger.contact_loss);
  }
  EXPECT_NE(serial[0].x_box, serial[1].x_box);
}

TEST_P(EveryEngine, StopsWhenAsked) {
  const std::atomic<bool> stop = true;
  RunOptions options;
  options.stop = &stop;
  shakedown::Setup setup = short_damper(20);
  setup.run.sample_rate = 0.1;  // also in the middle of a long way to the next sample
  const Trajectory result = engine->run(setup, options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_LT(result.end_time, 20);
  EXPECT_FALSE(result.time.empty());
}

TEST_P(EveryEngine, RefusesWhatItDoesNotModel) {
  EffectRecord record;
  record.name = "magnetism";
  record.engines = {{every_engine, {Fidelity::not_modelled, "nobody does"}}};
  record.apply = [](const EffectChoice&, int, Physics&) {};
  shakedown::Setup setup = short_damper();
  setup.effects.push_back({&record, {}, {"setup.toml", 12, 3}});
  try {
    engine->run(setup);
    FAIL() << "was not refused";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("setup.toml:12:3: magnetism"), std::string::npos) << text;
    EXPECT_NE(text.find(engine->name()), std::string::npos) << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, EveryEngine, ::testing::ValuesIn(engines_under_test()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
