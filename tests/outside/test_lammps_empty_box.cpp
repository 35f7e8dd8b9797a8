// SPDX-License-Identifier: MIT
// The box alone: closed forms, and the soft engine's exact flight.
#include <cmath>
#include <numbers>

#include "lammps.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

using LammpsEmptyBox = WithLammps;
using SlowLammpsEmptyBox = WithLammps;

TEST_F(LammpsEmptyBox, SwingsAsACosine) {
  const shakedown::Setup setup = empty_box(2);
  const Trajectory run = lammps->run(setup);
  ASSERT_EQ(run.time.size(), 201u);
  const double rate = 2 * std::numbers::pi * setup.spring.frequency;
  for (std::size_t k = 0; k < run.time.size(); ++k) {
    WITHIN(run.x_box[k], 0.1075 * std::cos(rate * run.time[k]), 4e-7, 2.6e-8) << k;
    WITHIN(run.v_box[k], -0.1075 * rate * std::sin(rate * run.time[k]), 4e-6, 2.2e-7) << k;
  }
  EXPECT_LT(run.health.ledger_error, 1.5e-6);  // seen: 9.9e-8
  EXPECT_TRUE(std::isnan(run.x_com.back()));
}

TEST_F(LammpsEmptyBox, RingsDownAsALinearlyDampedOne) {
  shakedown::Setup setup = empty_box(2);
  add_effect(setup, "blade_viscous_damping", {{"damping", 0.2}});
  const Trajectory run = lammps->run(setup);
  const double decay = 0.2 / (2 * setup.box.mass), free = 2 * std::numbers::pi * setup.spring.frequency,
               rate = std::sqrt(free * free - decay * decay);
  for (std::size_t k = 0; k < run.time.size(); ++k) {
    const double t = run.time[k],
                 x = 0.1075 * std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t));
    WITHIN(run.x_box[k], x, 5e-5, 9.4e-6) << k;
  }
  const double lost = run.initial_energy - run.total_energy.back();
  WITHIN(run.ledger.effect_loss.at(0), lost, 1e-6, 6.4e-8);
}

/// Effects that come as variables, against Runge-Kutta in the soft engine.
struct OnTheBox {
  const char* effect;
  std::map<std::string, ParameterValue> values;
  double place;    ///< difference that is let pass, m
  Tolerance loss;  ///< J
};
void PrintTo(const OnTheBox& one, std::ostream* out) { *out << one.effect; }

class SlowLammpsBoxEffects : public WithLammps, public testing::WithParamInterface<OnTheBox> {};

TEST_P(SlowLammpsBoxEffects, AreThoseOfTheSoftEngine) {
  shakedown::Setup setup = empty_box(1.5);
  add_effect(setup, GetParam().effect, GetParam().values);
  const Trajectory run = lammps->run(setup), other = soft->run(setup);
  WITHIN(run.ledger.effect_loss.at(0), other.ledger.effect_loss.at(0), GetParam().loss);
  EXPECT_LT(largest_difference(run, other), GetParam().place);
}

INSTANTIATE_TEST_SUITE_P(
    OnTheBox, SlowLammpsBoxEffects,
    testing::Values(
        // seen: 5.7e-6
        OnTheBox{"blade_quadratic_drag", {{"drag", 0.2}}, 1e-5, {1e-5, 9.4e-7}},
        // seen: 2.2e-8; of the loss the rounding of 0.15 J
        OnTheBox{"spring_cubic", {{"coefficient", 0.2}}, 4e-7, {5e-16, 2.8e-17}},
        // seen: 2.1e-8
        OnTheBox{"spring_quadratic", {{"coefficient", 0.2}}, 4e-7, {1e-7, 5.7e-9}},
        // seen: 8.5e-6
        OnTheBox{"clamp_dry_friction", {{"force", 0.1}}, 4e-5, {5e-6, 6.9e-7}},
        // seen: 1.9e-8
        OnTheBox{"pendulum", {{"length", 0.3}}, 3e-7, {1e-8, 5.2e-10}},
        // seen: 2.7e-8
        OnTheBox{"second_mode",
                 {{"amplitude", 2.0}, {"frequency", 9.0}, {"rate", 3.0}, {"phase", 0.3}},
                 5e-7,
                 {6e-9, 3.3e-10}},
        // seen: 5.7e-7
        OnTheBox{"user_force",
                 {{"force", std::string("-c*v*exp(-((x-x0)/w)^2) + 0.05*sin(7*t)")},
                  {"constants", std::map<std::string, double>{{"c", 0.4}, {"x0", 0.045}, {"w", 0.012}}}},
                 1e-5,
                 {8e-7, 4.5e-8}},
        // seen: 1.9e-8
        OnTheBox{"constant_acceleration", {{"acceleration", Vec3(0.3, 0, 0)}}, 3e-7, {5e-8, 2.7e-9}},
        // seen: 2.0e-8
        OnTheBox{"oscillating_acceleration",
                 {{"amplitude", Vec3(0.3, 0, 0)}, {"frequency", 2.0}, {"phase", 0.4}},
                 3e-7,
                 {3e-8, 1.7e-9}}),
    [](const auto& one) { return std::string(one.param.effect); });

/// Friction that is smooth cannot hold the box: it creeps.
TEST_F(SlowLammpsEmptyBox, CreepsWhereItShouldStick) {
  shakedown::Setup setup = empty_box(4);
  add_effect(setup, "clamp_dry_friction", {{"force", 0.5}});
  const Trajectory run = lammps->run(setup), other = soft->run(setup);
  EXPECT_EQ(other.v_box.back(), 0);
  EXPECT_LT(std::abs(run.x_box.back() - other.x_box.back()), 2e-3);  // seen: 1.1e-3
}

}  // namespace
