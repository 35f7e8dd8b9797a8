// SPDX-License-Identifier: MIT
// Every effect in every engine: what each record promises, held against short runs at its typical strength.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "catalogue.hpp"
#include "setup_file.hpp"
#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// The setup of an effect's own example: its typical strength. Long enough for the layer to land on both
/// walls.
shakedown::Setup example_setup(std::string_view effects_text, double duration = 0.4) {
  shakedown::Setup setup = parse_setup(effects_text, "example", all_effects());
  setup.run.duration = duration;
  setup.run.sample_rate = 100;
  setup.soft.contact_time = 1e-3;
  return setup;
}

class EveryEffect : public testing::TestWithParam<std::tuple<EngineUnderTest, const EffectRecord*>> {
 protected:
  const EngineUnderTest& tested = std::get<0>(GetParam());
  const EffectRecord& record = *std::get<1>(GetParam());
  std::unique_ptr<Engine> engine = tested.make();
  shakedown::Setup setup = example_setup(example_of(record) + what_it_needs());

  std::string what_it_needs() const {
    return record.needs.empty() ? "" : example_of(*find_effect(record.needs));
  }
  /// The setup without the effect.
  shakedown::Setup plain() const {
    shakedown::Setup without = setup;
    std::erase_if(without.effects, [&](const EffectChoice& choice) { return choice.record == &record; });
    return without;
  }
  Fidelity fidelity() const { return engine->can_model(record).fidelity; }
  bool needs_neutral() const {
    for (const Parameter& parameter : record.parameters)
      if (!std::isnan(parameter.neutral)) return true;
    return false;
  }
};

/// Of E0: closed forms, dense solutions, soft contacts.
double promised_ledger(const EngineUnderTest& tested, Fidelity fidelity) {
  if (tested.name != "hard") return 1e-9;
  return fidelity == Fidelity::exact ? 1e-12 : 1e-10;
}

void expect_balances(const Trajectory& result, double ledger) {
  EXPECT_LE(result.health.ledger_error, ledger);
  EXPECT_LE(result.health.momentum_error, 1e-12);
  // not WITHIN: the engines promise so much
  EXPECT_NEAR((result.total_energy.back() + result.ledger.total_loss()) / result.initial_energy, 1, ledger);
  for (const double loss : result.ledger.contact_loss) EXPECT_GE(loss, 0);
}

TEST_P(EveryEffect, KeepsItsPromisesOrIsRefused) {
  if (fidelity() == Fidelity::not_modelled) {
    try {
      engine->run(setup);
      FAIL() << "was not refused";
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("example:2:"), std::string::npos) << text;
      EXPECT_NE(text.find(record.name), std::string::npos) << text;
      EXPECT_NE(text.find("--engine"), std::string::npos) << text;
    }
    return;
  }
  if (record.acts_on == ActsOn::camera) setup.run.duration = 0.1;  // the motion is that of none
  const Trajectory result = engine->run(setup);
  expect_balances(result, promised_ledger(tested, fidelity()));
  ASSERT_EQ(result.ledger.effect_loss.size(), setup.effects.size());
  if (record.dissipative) {
    EXPECT_GE(result.ledger.effect_loss[0], 0);
  }
}

TEST_P(EveryEffect, ChangesTheMotionUnlessItActsOnTheCameraAndAlwaysAlike) {
  if (fidelity() == Fidelity::not_modelled) return;
  setup.run.duration = 0.06;
  const Trajectory with = engine->run(setup), without = engine->run(plain()), again = engine->run(setup);
  EXPECT_EQ(with.x_box, again.x_box);
  EXPECT_EQ(with.total_energy, again.total_energy);
  EXPECT_EQ(with.ledger.effect_loss, again.ledger.effect_loss);
  if (record.acts_on == ActsOn::camera) {
    EXPECT_EQ(with.x_box, without.x_box);
    EXPECT_EQ(with.x_com, without.x_com);
  } else {
    EXPECT_TRUE(with.x_box != without.x_box || with.x_com != without.x_com);
  }
}

TEST_P(EveryEffect, IsDroppedAtItsNeutralValueAndThenLeavesNoTrace) {
  if (fidelity() == Fidelity::not_modelled || !needs_neutral()) return;
  setup.run.duration = 0.05;
  for (const Parameter& parameter : record.parameters)
    if (!std::isnan(parameter.neutral))
      for (const std::string axis : {"", ".x", ".y", ".z"})
        if ((parameter.kind == ParameterKind::vector) == !axis.empty())
          set_number(setup, std::string(record.name) + "." + std::string(parameter.name) + axis,
                     parameter.neutral, all_effects());
  EXPECT_EQ(digest(setup), digest(plain()));
  const shakedown::Setup read = parse_setup(write_setup(setup), "neutral", all_effects());
  EXPECT_EQ(read.effects.size(), plain().effects.size());
  const Trajectory with = engine->run(read), without = engine->run(plain());
  EXPECT_EQ(with.x_box, without.x_box);
  EXPECT_EQ(with.x_com, without.x_com);
  EXPECT_EQ(with.total_energy, without.total_energy);
  EXPECT_EQ(with.loss, without.loss);
}

INSTANTIATE_TEST_SUITE_P(Engines, EveryEffect,
                         testing::Combine(testing::ValuesIn(engines_under_test()),
                                          testing::ValuesIn(all_effects().begin(), all_effects().end())),
                         [](const auto& tested) {
                           return std::get<0>(tested.param).name + "_" +
                                  std::string(std::get<1>(tested.param)->name);
                         });

class SeveralEffects : public testing::TestWithParam<EngineUnderTest> {};

/// Everything on that the engine models, at typical strength: effects combine freely, but for two that
/// replace the same part of the model.
TEST_P(SeveralEffects, AtOnceKeepTheirBooks) {
  const auto engine = GetParam().make();
  std::string text;
  std::set<std::string_view> claimed;
  for (const EffectRecord* record : all_effects())
    if (engine->can_model(*record).fidelity != Fidelity::not_modelled &&
        (record->claims.empty() || claimed.insert(record->claims).second))
      text += example_of(*record);
  const shakedown::Setup setup = example_setup(text, 0.6);
  const Trajectory result = engine->run(setup);
  expect_balances(result, promised_ledger(GetParam(), Fidelity::to_stated_error));
  for (std::size_t i = 0; i < setup.effects.size(); ++i)
    if (setup.effects[i].record->dissipative) {
      EXPECT_GE(result.ledger.effect_loss[i], 0) << setup.effects[i].record->name;
    }
}

/// Closed forms only: viscous, dry friction, both accelerations, added mass, a push, friction and attraction
/// of grains.
TEST_P(SeveralEffects, InClosedFormCloseToRounding) {
  if (GetParam().name == "bullet") return;
  std::string text;
  for (const std::string_view name :
       {"grain_friction", "grain_cohesion", "side_wall_restitution", "grain_polydispersity",
        "blade_viscous_damping", "clamp_dry_friction", "blade_mass", "initial_box_velocity",
        "constant_acceleration", "oscillating_acceleration"})
    text += example_of(*find_effect(name));
  const Trajectory result = GetParam().make()->run(example_setup(text, 0.6));
  expect_balances(result, promised_ledger(GetParam(), Fidelity::exact));
}

INSTANTIATE_TEST_SUITE_P(Engines, SeveralEffects, testing::ValuesIn(engines_under_test()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
