// SPDX-License-Identifier: MIT
// What acts on the grains in flight, against closed forms.
#include <cmath>
#include <numbers>

#include "soft_effects.hpp"
#include "within.hpp"

using namespace shakedown;

TEST_F(SoftEffects, AccelerationsBendTheFlightExactly) {
  shakedown::Setup setup =
      closed_cube({[](const EffectChoice&, int index, Physics& physics) {
                     physics.grains.constant.add(Vec3(0.3, 0, -0.1), index);
                   },
                   [](const EffectChoice&, int index, Physics& physics) {
                     physics.grains.harmonics.push_back({Vec3(2, 1, 0), 5.0, 0.7, index});
                   }},
                  {{-0.05, 0, 0, 0.02, 0.01, 0}});
  setup.run.duration = 0.5;
  const Trajectory result = run(setup, 1e-10);  // of a start energy that the fields multiply by a hundred
  const double w = 2 * std::numbers::pi * 5;
  for (std::size_t k = 0; k < result.time.size(); k += 10) {
    const double t = result.time[k];
    const double harmonic = 2 / w * (std::cos(0.7) * t - (std::sin(w * t + 0.7) - std::sin(0.7)) / w);
    WITHIN(result.x_com[k], -0.05 + 0.02 * t + 0.15 * t * t + harmonic, 1e-13, 1.4e-14);
  }
}

TEST_F(SoftEffects, DragBringsAGrainToItsTerminalVelocity) {
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int index, Physics& physics) {
                                          physics.grains.constant.add(Vec3(2, 0, 0), index);
                                        },
                                        [](const EffectChoice&, int index, Physics& physics) {
                                          physics.grains.drag.add({0.08, 0}, index);
                                        }},
                                       {{-0.09, 0, 0, 0, 0, 0}});
  setup.run.duration = 0.6;
  const Trajectory result = run(setup);
  const double rate = 0.08 / 4.04e-3, terminal = 2 / rate;
  for (std::size_t k = 0; k < result.time.size(); k += 20) {
    const double t = result.time[k];
    // second order in the step
    WITHIN(result.x_com[k], -0.09 + terminal * (t - (1 - std::exp(-rate * t)) / rate), 2e-9, 1.2e-10);
  }
  EXPECT_GT(result.ledger.effect_loss[1], 0);
  EXPECT_LT(result.ledger.effect_loss[0], 0);
}

TEST_F(SoftEffects, DragInTheDamperActsOnTheBoxToo) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
    physics.grains.drag.add({1e-3, 1e-2}, index);
  }});
  setup.box.length = 0.104;
  const Trajectory result = run(setup);
  EXPECT_GT(result.ledger.effect_loss[0], 1e-4 * result.initial_energy);
}

TEST_F(SoftEffects, FormulasOnTheGrainsEnterTheirLine) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
    physics.grains.free.push_back(
        {[](double x, double v, double t) { return -0.02 * v - 0.05 * x + 1e-3 * std::sin(9 * t); }, index});
  }});
  const Trajectory result = run(setup);
  EXPECT_NE(result.ledger.effect_loss[0], 0);
}

TEST_F(SoftEffects, ArcPushesGrainsAcross) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
    physics.grains.arc_length = 0.59;
    physics.grains.arc_effect = index;
  }});
  setup.box.length = 0.104;
  const Trajectory result = run(setup);
  EXPECT_NE(result.ledger.effect_loss[0], 0);
}
