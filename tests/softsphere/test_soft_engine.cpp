// SPDX-License-Identifier: MIT
#include "soft_engine.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "halving_check.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

shakedown::Setup short_run(double duration = 0.2) {
  shakedown::Setup setup;
  setup.run.duration = duration;
  return setup;
}

/// The paper's damper scaled to N grains at the same filling.
shakedown::Setup scaled_damper(int count) {
  shakedown::Setup setup;
  const double times = count / 37.0;
  setup.grains.count = count;
  setup.box.mass *= times;
  setup.box.width[0] = setup.box.width[1] = 0.05 * std::sqrt(times);
  return setup;
}

}  // namespace

TEST(SoftEngine, DigitsDoNotDependOnHowPairsAreFound) {
  const Trajectory by_list = make_soft_engine(PairSearch::neighbour_list)->run(short_run());
  const Trajectory by_bullet = make_soft_engine(PairSearch::every_step)->run(short_run());
  EXPECT_EQ(by_list.x_box, by_bullet.x_box);
  EXPECT_EQ(by_list.total_energy, by_bullet.total_energy);
  EXPECT_EQ(by_list.ledger.contact_loss, by_bullet.ledger.contact_loss);
}

TEST(SlowSoftEngine, CarriesTenThousandGrains) {
  shakedown::Setup setup = scaled_damper(10000);
  setup.run.duration = 0.02;
  const Trajectory result = make_soft_engine()->run(setup);
  EXPECT_LE(result.health.ledger_error, 1e-12);
  EXPECT_LE(result.health.momentum_error, 1e-12);
  EXPECT_GT(result.collisions[0], 0);
}

TEST(SoftEngine, LedgerStaysClosedWhereAllGrainsPileUp) {
  shakedown::Setup setup = short_run(2);
  setup.soft.contact_time = 1e-3;
  const Trajectory result = make_soft_engine()->run(setup);
  EXPECT_LE(result.health.ledger_error, 1e-12);
  EXPECT_LT(result.health.deepest_overlap, 3e-4);
  EXPECT_GT(result.health.deepest_overlap, 1e-4);
}

TEST(SoftEngine, SaysWhenTheStepIsTooCoarse) {
  shakedown::Setup setup = short_run(0.01);
  EXPECT_TRUE(make_soft_engine()->run(setup).health.notes.empty());
  setup.soft.steps_per_contact = 8;
  const auto notes = make_soft_engine()->run(setup).health.notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("restitution is off by up to 0.019"), std::string::npos) << notes[0];
}

TEST(SoftEngine, RefusesWhatItCannotRun) {
  shakedown::Setup setup = short_run();
  setup.domain = Domain::periodic;
  setup.soft.steps_per_contact = 2;
  setup.soft.contact_time = 0;
  try {
    make_soft_engine()->run(setup);
    FAIL() << "was not refused";
  } catch (const InputError& error) {
    ASSERT_EQ(error.violations.size(), 3u);
    EXPECT_EQ(error.violations[0].key, "domain.kind");
  }
}

TEST(SoftEngine, StopsWhenContactsAreTooSoftForTheSetup) {
  shakedown::Setup setup = short_run(1);
  setup.soft.contact_time = 0.03;
  try {
    make_soft_engine()->run(setup);
    FAIL() << "was not refused";
  } catch (const PhysicsError& error) {
    const std::string said = error.what();
    EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 12) << said;  // of contacts as many as are read
  }
}

TEST(SoftEngine, ClosedBoxConservesEnergyOfElasticGrains) {
  shakedown::Setup setup = short_run(0.5);
  setup.domain = Domain::closed;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.06;
  setup.release.packing = Packing::spread;
  setup.restitution.grain_grain = setup.restitution.grain_wall = 1;
  const Trajectory result = make_soft_engine()->run(setup);
  EXPECT_LE(result.health.ledger_error, 1e-12);
  EXPECT_LE(result.health.momentum_error, 1e-12);
  EXPECT_GT(result.collisions[0], 100);
  // Verlet at twenty steps per contact
  WITHIN(result.total_energy.back() / result.initial_energy, 1, 5e-3, 3.3e-4);
  EXPECT_EQ(result.x_box.back(), 0);
}

TEST(SoftEngine, HalvingTheStepChangesLittleAndEverLess) {
  shakedown::Setup setup = short_run();
  const HalvingCheck check = halving_check(setup, 0.03);
  EXPECT_LT(check.change_of_box[0], 2e-6);  // metre
  EXPECT_LT(check.change_of_box[1], check.change_of_box[0]);
  WITHIN(check.predicted_restitution_error, 3.1e-3, 2e-4, 3.1e-5);
  WITHIN(check.steps_per_contact, 20.1, 9e-14, 4.5e-15);
}
