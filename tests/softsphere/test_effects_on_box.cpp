// SPDX-License-Identifier: MIT
// What acts on the box beside its spring, against closed forms.
#include <cmath>
#include <numbers>

#include "soft_effects.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

const double angular_frequency = 2 * std::numbers::pi * 1.23;
constexpr double mass = 0.434, start = 0.1075;

double stiffness() { return mass * angular_frequency * angular_frequency; }

}  // namespace

TEST_F(SoftEffects, ViscousBoxDecaysExponentially) {
  shakedown::Setup setup = empty_box(
      {[](const EffectChoice&, int index, Physics& physics) { physics.box.viscous.add(0.3, index); }});
  setup.run.duration = 5;
  const Trajectory result = run(setup);
  const double decay = 0.3 / (2 * mass),
               rate = std::sqrt(angular_frequency * angular_frequency - decay * decay);
  for (std::size_t k = 0; k < result.time.size(); k += 50) {
    const double t = result.time[k];
    WITHIN(result.x_box[k],
           start * std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t)), 6e-14,
           3.1e-15);
  }
  WITHIN(result.ledger.effect_loss[0] + result.total_energy.back(), result.initial_energy, 1e-14, 7.5e-15);
}

TEST_F(SoftEffects, DryFrictionTakesTheSameFromEveryExtremumAndThenSticks) {
  shakedown::Setup setup = empty_box(
      {[](const EffectChoice&, int index, Physics& physics) { physics.box.dry_friction.add(0.3, index); }});
  setup.run.duration = 4;
  const Trajectory result = run(setup);
  const double drop = 2 * 0.3 / stiffness();
  // Extrema at half periods; it sticks at the first one within F / k of the centre: 107.5 - 4 x 23.1 = 14.9
  // -> -(-8.2) ...
  int half_periods = 0;
  double extremum = start;
  while (extremum > 0.3 / stiffness()) {
    extremum -= drop;
    ++half_periods;
  }
  const double rest = (half_periods % 2 == 0 ? 1 : -1) * extremum;
  WITHIN(result.x_box.back(), rest, 5e-15, 2.6e-16);
  EXPECT_EQ(result.v_box.back(), 0);
  EXPECT_EQ(result.x_box.back(), result.x_box[result.x_box.size() - 100]);
  const double rate = angular_frequency, offset = 0.3 / stiffness();
  for (std::size_t k = 0; result.time[k] < 0.4; k += 20)
    WITHIN(result.x_box[k], offset + (start - offset) * std::cos(rate * result.time[k]), 1e-14, 7e-16);
}

TEST_F(SoftEffects, ForcedBoxFollowsTheClosedForm) {
  shakedown::Setup setup = empty_box({[](const EffectChoice&, int index, Physics& physics) {
    physics.box.constant.add(0.2, index);
    physics.box.harmonics.push_back({0.1, 2.0, 0.4, index});
  }});
  setup.run.duration = 3;
  const Trajectory result = run(setup);
  const double w = angular_frequency, drive = 2 * std::numbers::pi * 2.0;
  const double forced = 0.1 / mass / (w * w - drive * drive), shift = 0.2 / stiffness();
  const double a = start - shift - forced * std::sin(0.4), b = -forced * drive * std::cos(0.4) / w;
  for (std::size_t k = 0; k < result.time.size(); k += 50) {
    const double t = result.time[k];
    WITHIN(result.x_box[k],
           shift + forced * std::sin(drive * t + 0.4) + a * std::cos(w * t) + b * std::sin(w * t), 8e-14,
           4e-15);
  }
}

TEST_F(SoftEffects, CubicSpringHasDuffingsPeriod) {
  shakedown::Setup setup = empty_box(
      {[](const EffectChoice&, int, Physics& physics) { physics.spring_cubic = 0.5 / (start * start); }});
  setup.run.duration = 3;
  setup.run.sample_rate = 5000;
  const Trajectory result = run(setup);
  // Quarter period = integral of dx / v by the substitution x = A sin(s), to which the midpoint rule
  // converges geometrically.
  double quarter = 0;
  constexpr int points = 60;
  for (int k = 0; k < points; ++k) {
    const double s = (k + 0.5) / points * std::numbers::pi / 2;
    quarter += std::numbers::pi / 2 / points /
               (angular_frequency * std::sqrt(1 + 0.25 * (1 + std::sin(s) * std::sin(s))));
  }
  std::size_t k = 1;
  while (result.x_box[k] > 0) ++k;
  const double share = result.x_box[k - 1] / (result.x_box[k - 1] - result.x_box[k]);
  WITHIN(result.time[k - 1] + share / 5000, quarter, 3e-11, 1.5e-12);
  WITHIN(result.total_energy.back() / result.initial_energy, 1, 1e-12, 1.5e-13);
}

TEST_F(SoftEffects, FormulasOnTheBoxEnterTheirLine) {
  const Trajectory result = run(empty_box({[](const EffectChoice&, int index, Physics& physics) {
    physics.box.free.push_back({[](double, double v, double) { return -0.8 * v * std::abs(v); }, index});
  }}));
  EXPECT_GT(result.ledger.effect_loss[0], 0.1 * result.initial_energy);
}

/// A spring that turns the box within a few steps: what the steps do not follow is no result.
TEST_F(SoftEffects, ARunThatDoesNotBalanceIsRefused) {
  shakedown::Setup setup =
      with({[](const EffectChoice&, int, Physics& physics) { physics.spring_cubic = 4e22; }});
  setup.box.length = 0.024442;
  setup.spring.frequency = 2688.8;
  setup.grains.mass = 42.966;
  setup.release.displacement = 1e-12;
  setup.release.packing = Packing::spread;
  setup.release.kinetic_energy_fraction = 0;
  try {
    make_soft_engine()->run(setup);
    FAIL() << "was not refused";
  } catch (const PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("do not balance"), std::string::npos) << error.what();
  }
}
