// SPDX-License-Identifier: MIT
// The second coding of the damper: closed forms of each effect, and the first coding beside it.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "apart_engine.hpp"
#include "engines/setups.hpp"
#include "impact_law.hpp"
#include "viscoelastic_contact.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double radius = 0.005, grain_mass = 4.04e-3, box_mass = 0.434;

const std::unique_ptr<Engine> second = make_apart_engine();

/// A wide box at rest on a spring so weak that it does nothing; one sample at the end.
shakedown::Setup impact_of(double seconds, double steps = 50) {
  shakedown::Setup setup;
  setup.release.displacement = 0;
  setup.spring.frequency = 1e-6;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.1;
  setup.soft.steps_per_contact = steps;
  setup.run.duration = seconds;
  setup.run.sample_rate = 1 / seconds;
  return setup;
}

shakedown::Setup empty_box(double seconds) {
  shakedown::Setup setup;
  setup.grains.count = 0;
  setup.run.duration = seconds;
  setup.run.sample_rate = 100;
  return setup;
}

double closing_after(const shakedown::Setup& setup, double speed) {
  const Trajectory run = run_with(*second, setup,
                                  {{Vec3(-radius - 1e-3, 0, 0), Vec3(speed / 2, 0, 0)},
                                   {Vec3(radius + 1e-3, 0, 0), Vec3(-speed / 2, 0, 0)}});
  return (run.end_state.velocity[1].x() - run.end_state.velocity[0].x()) / speed;
}

TEST(ApartLaw, SpringLosesByItsDepthAlone) {
  const apart::LatchingSpring spring = apart::LatchingSpring::of(0.6, 2e-3, 3e-4);
  WITHIN(spring.unload / spring.load, 1 / 0.36, 1e-14, 6.2e-16);
  const double load = std::numbers::pi / 2 * std::sqrt(2e-3 / spring.load),
               unload = std::numbers::pi / 2 * std::sqrt(2e-3 / spring.unload);
  WITHIN(load + unload, 3e-4, 1e-18, 6.7e-20);
  EXPECT_EQ(spring.force(1e-5, 1e-5), spring.load * 1e-5);
  EXPECT_EQ(spring.force(1e-6, 1e-5), 0);
}

TEST(ApartLaw, OfViscoelasticSpheresIsTheIntegratedOne) {
  for (const double u : {0.1, 0.3, 0.6})
    WITHIN(apart::pade_restitution(u), viscoelastic_restitution(u * u), 2e-3, 9.6e-4);
  for (const double u : {1.0, 1.5})
    WITHIN(apart::pade_restitution(u), viscoelastic_restitution(u * u), 2e-2, 8.3e-3);
}

TEST(ApartImpact, ReboundsByTheRestitution) {
  for (const double speed : {0.01, 0.3, 2.0})
    WITHIN(closing_after(impact_of(2e-3 / speed + 0.01), speed), 0.75, 2e-3, 2.4e-4);
}

TEST(ApartImpact, PushesTheBoxAsItIsPushed) {
  const Trajectory run =
      run_with(*second, impact_of(0.01), {{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(0.5, 0, 0)}});
  const double grain = run.end_state.velocity[0].x(), box = run.end_state.v_box;
  WITHIN((box - grain) / 0.5, 0.76, 1e-3, 9.7e-5);
  WITHIN(grain_mass * grain + box_mass * box, grain_mass * 0.5, 1e-17, 8.7e-19);
  const double reduced = grain_mass * box_mass / (grain_mass + box_mass),
               lost = reduced * 0.125 * (1 - std::pow((box - grain) / 0.5, 2));
  WITHIN(run.ledger.contact_loss[1], lost, 3e-18, 1.9e-19);
}

TEST(ApartImpact, OfUnequalGrainsIsThatOfTheFirstCoding) {
  shakedown::Setup setup;
  setup.run.duration = 0.5;
  add_effect(setup, "grain_polydispersity", {{"relative_deviation", 0.05}});
  const Trajectory run = second->run(setup), other = make_soft_engine()->run(setup);
  WITHIN(run.x_com.front(), other.x_com.front(), 2e-16, 2.8e-17);
  WITHIN(run.x_com.back(), other.x_com.back(), 3e-3, 2.7e-4);
}

TEST(ApartImpact, FallsWithThePowerOfTheSpeed) {
  shakedown::Setup setup = impact_of(0.03);
  add_effect(setup, "velocity_dependent_restitution", {{"exponent", 0.2}, {"reference_speed", 0.3}});
  WITHIN(closing_after(setup, 1.2), 0.75 * std::pow(4, -0.2), 3e-3, 2.6e-4);
}

TEST(ApartImpact, FallsAsViscoelasticSpheresDo) {
  shakedown::Setup setup = impact_of(0.03);
  add_effect(setup, "velocity_dependent_restitution",
             {{"law", std::string("viscoelastic")}, {"reference_speed", 0.3}});
  for (const double speed : {0.1, 0.3, 1.2})
    WITHIN(closing_after(setup, speed),
           viscoelastic_restitution(viscoelastic_damping(0.75) * std::pow(speed / 0.3, 0.2)), 2e-3, 1.4e-4);
}

TEST(ApartImpact, HasTheSideWallsRestitution) {
  shakedown::Setup setup = impact_of(0.01);
  add_effect(setup, "side_wall_restitution", {{"restitution", 0.5}});
  const Trajectory run = run_with(*second, setup, {{Vec3(0, 0, 0.05 - radius - 1e-3), Vec3(0, 0, 0.5)}});
  WITHIN(-run.end_state.velocity[0].z() / 0.5, 0.5, 4e-5, 2.4e-6);
}

/// An impact that slides throughout takes mu (1 + e) v_n off the slip; one that sticks turns it round.
TEST(ApartImpact, RubsAsRigidSpheresDo) {
  for (const double tangent : {0.4, 0.02}) {
    shakedown::Setup setup = impact_of(0.01, 100);
    setup.domain = Domain::closed;
    add_effect(setup, "grain_friction", {{"grain_grain", 0.1}, {"grain_wall", 0.1}});
    const Trajectory run =
        run_with(*second, setup, {{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(0.5, tangent, 0)}});
    const double slip = run.end_state.velocity[0].y() + radius * run.end_state.spin[0].z(),
                 reversed = std::max(tangent - 3.5 * 0.1 * 1.76 * 0.5, -tangent);
    WITHIN(slip, reversed, 2e-2, 2e-3);
  }
}

TEST(ApartImpact, LosesTheDepthOfTheWell) {
  shakedown::Setup setup = impact_of(0.05, 100);
  add_effect(setup, "grain_cohesion", {{"force", 0.02}, {"range", 2e-4}});
  const double inside = 0.04 + 2 * 0.02 * 2e-4 / (grain_mass / 2),
               after = std::sqrt(0.5625 * inside - 2 * 0.02 * 2e-4 / (grain_mass / 2));
  WITHIN(closing_after(setup, 0.2), after / 0.2, 2e-2, 3.5e-3);
}

/// Below the escape speed two grains stay together.
TEST(ApartImpact, CatchesSlowGrains) {
  shakedown::Setup setup = impact_of(0.5);
  add_effect(setup, "grain_cohesion", {{"force", 0.02}, {"range", 2e-4}});
  const Trajectory run = run_with(
      *second, setup,
      {{Vec3(-radius - 2e-4, 0, 0), Vec3(0.01, 0, 0)}, {Vec3(radius + 2e-4, 0, 0), Vec3(-0.01, 0, 0)}});
  EXPECT_LT((run.end_state.position[0] - run.end_state.position[1]).norm(), 2 * radius + 2e-4);
}

/// A grain pressed on a wall loses in each small impact until it lies still.
TEST(ApartImpact, ComesToRestUnderItsWeight) {
  shakedown::Setup setup = impact_of(2);
  setup.domain = Domain::closed;
  add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(1, 0, 0)}});
  const Trajectory run = run_with(*second, setup, {{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(0, 0, 0)}});
  EXPECT_LT(std::abs(run.end_state.velocity[0].x()), 2e-4);          // seen: 1.2e-5
  EXPECT_LT(std::abs(run.end_state.position[0].x() - 0.045), 1e-5);  // seen: 1.2e-6
}

TEST(ApartBox, SwingsAsACosine) {
  const shakedown::Setup setup = empty_box(5);
  const Trajectory run = second->run(setup);
  for (std::size_t k = 0; k < run.time.size(); ++k)
    WITHIN(run.x_box[k], 0.1075 * std::cos(2 * std::numbers::pi * 1.23 * run.time[k]), 1e-6, 6.4e-8);
}

struct OnTheBox {
  const char* effect;
  std::map<std::string, ParameterValue> values;
};
void PrintTo(const OnTheBox& one, std::ostream* out) { *out << one.effect; }

class ApartBoxEffects : public testing::TestWithParam<OnTheBox> {};

TEST_P(ApartBoxEffects, AreThoseOfTheFirstCoding) {
  shakedown::Setup setup = empty_box(5);
  add_effect(setup, GetParam().effect, GetParam().values);
  const Trajectory run = second->run(setup), other = make_hard_engine()->run(setup);
  double most = 0;
  for (std::size_t k = 0; k < run.time.size(); ++k)
    most = std::max(most, std::abs(run.x_box[k] - other.x_box[k]));
  EXPECT_LT(most, 1e-6);  // seen: 3.1e-9 (dry friction) to 1.1e-7
  WITHIN(run.ledger.effect_loss.at(0), other.ledger.effect_loss.at(0), 1e-7, 7.3e-9);
}

INSTANTIATE_TEST_SUITE_P(
    OnTheBox, ApartBoxEffects,
    testing::Values(
        OnTheBox{"blade_viscous_damping", {{"damping", 0.2}}},
        OnTheBox{"blade_quadratic_drag", {{"drag", 0.2}}}, OnTheBox{"clamp_dry_friction", {{"force", 0.1}}},
        OnTheBox{"spring_cubic", {{"coefficient", 0.2}}},
        OnTheBox{"spring_quadratic", {{"coefficient", 0.2}}}, OnTheBox{"pendulum", {{"length", 0.3}}},
        OnTheBox{"second_mode", {{"amplitude", 2.0}, {"frequency", 9.0}, {"rate", 3.0}, {"phase", 0.3}}},
        OnTheBox{"blade_mass", {{"mass", 0.02}}},
        OnTheBox{"constant_acceleration", {{"acceleration", Vec3(0.3, 0, 0)}}},
        OnTheBox{"oscillating_acceleration",
                 {{"amplitude", Vec3(0.3, 0, 0)}, {"frequency", 2.0}, {"phase", 0.4}}}),
    [](const auto& one) { return std::string(one.param.effect); });

/// What acts on grains in flight.
class ApartFlight : public testing::TestWithParam<OnTheBox> {};

TEST_P(ApartFlight, IsThatOfTheFirstCoding) {
  shakedown::Setup setup;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.2;
  setup.run.duration = 0.1;
  add_effect(setup, GetParam().effect, GetParam().values);
  const std::vector<PlacedGrain> grains{{Vec3(0.1075, 0, 0), Vec3(0.2, 0.1, -0.2)},
                                        {Vec3(0.15, 0.02, 0), Vec3(0, 0, 0)}};
  const Trajectory run = run_with(*second, setup, grains),
                   other = run_with(*make_soft_engine(), setup, grains);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT((run.end_state.position[i] - other.end_state.position[i]).norm(),
              1e-6);  // seen: 4e-14 to 8.4e-7
    EXPECT_LT((run.end_state.velocity[i] - other.end_state.velocity[i]).norm(),
              1e-5);  // seen: 1e-14 to 4.4e-6
  }
  WITHIN(run.ledger.effect_loss.at(0), other.ledger.effect_loss.at(0), 6e-9, 3.3e-10);
}

INSTANTIATE_TEST_SUITE_P(
    OnGrains, ApartFlight,
    testing::Values(OnTheBox{"grain_air_drag", {{"linear", 0.02}, {"quadratic", 0.02}}},
                    OnTheBox{"constant_acceleration", {{"acceleration", Vec3(0.3, -0.2, 0.1)}}},
                    OnTheBox{"oscillating_acceleration",
                             {{"amplitude", Vec3(0.3, 0.1, 0)}, {"frequency", 5.0}, {"phase", 0.4}}},
                    OnTheBox{"blade_arc", {{"blade_length", 0.59}}}),
    [](const auto& one) { return std::string(one.param.effect); });

TEST(Apart, KeepsItsBook) {
  shakedown::Setup setup;
  setup.run.duration = 2;
  add_effect(setup, "grain_friction", {{"grain_grain", 0.2}, {"grain_wall", 0.2}});
  add_effect(setup, "grain_cohesion", {{"force", 0.01}});
  add_effect(setup, "blade_viscous_damping", {{"damping", 0.05}});
  add_effect(setup, "grain_air_drag", {{"linear", 1e-3}, {"quadratic", 1e-3}});
  const Trajectory run = second->run(setup);
  EXPECT_LT(run.health.ledger_error, 6e-8);  // seen: 3.3e-9
  for (const double loss : run.ledger.contact_loss) EXPECT_GT(loss, 0);
}

TEST(Apart, BeginsAsTheOthersAndRunsAlikeAgain) {
  shakedown::Setup setup;
  setup.run.duration = 0.3;
  const Trajectory run = second->run(setup, {3, {}}), other = make_soft_engine()->run(setup, {3, {}});
  WITHIN(run.x_com.front(), other.x_com.front(), 2e-16, 2.8e-17);
  WITHIN(run.initial_energy / other.initial_energy, 1, 1e-14, 6.7e-16);
  EXPECT_EQ(run.x_box, second->run(setup, {3, {}}).x_box);
  double most = 0;
  for (std::size_t k = 0; k < run.time.size(); ++k)
    most = std::max(most, std::abs(run.x_box[k] - other.x_box[k]));
  EXPECT_LT(most, 3e-4);  // seen: 1.9e-5
}

TEST(Apart, RefusesWhatItDoesNotKnow) {
  shakedown::Setup setup;
  add_effect(setup, "clamp_dahl_friction", {{"force", 0.1}, {"travel", 1e-3}});
  EXPECT_THROW(second->run(setup), InputError);
  setup.effects.clear();
  add_effect(setup, "grain_friction", {{"grain_grain", 0.2}, {"tangential_restitution", 0.5}});
  EXPECT_THROW(second->run(setup), InputError);
  setup.effects.clear();
  setup.restitution.grain_wall = 0.05;
  EXPECT_THROW(second->run(setup), InputError);
  setup = {};
  setup.domain = Domain::periodic;
  EXPECT_THROW(second->run(setup), InputError);
}

}  // namespace
