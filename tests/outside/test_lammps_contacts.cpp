// SPDX-License-Identifier: MIT
// Contacts that are no plain spring and dashpot: Hertz's with viscous losses, and attraction beside them.
#include <cmath>

#include "lammps.hpp"
#include "outside_errors.hpp"
#include "viscoelastic_contact.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

using LammpsContact = WithLammps;
using SlowLammpsContact = WithLammps;

constexpr double radius = 0.005, grain_mass = 4.04e-3, box_mass = 0.434;

/// One sample at the end of `seconds`, with many steps in a contact.
shakedown::Setup impact_of(double seconds) {
  shakedown::Setup setup = resting_box();
  setup.soft.steps_per_contact = 100;
  setup.run.duration = seconds;
  setup.run.sample_rate = 1 / seconds;
  return setup;
}

shakedown::Setup viscoelastic_impact(double seconds) {
  shakedown::Setup setup = impact_of(seconds);
  add_effect(setup, "velocity_dependent_restitution",
             {{"law", std::string("viscoelastic")}, {"reference_speed", 0.3}});
  return setup;
}

/// Of the law in closed form: 0.75 between grains, 0.76 at walls, at 0.3 m/s.
double restitution_at(double reference, double speed) {
  return viscoelastic_restitution(viscoelastic_damping(reference) * std::pow(speed / 0.3, 0.2));
}

/// At the reference speed, far below and far above it.
class SlowLammpsViscoelastic : public WithLammps, public testing::WithParamInterface<double> {};

TEST_P(SlowLammpsViscoelastic, TwoGrainsReboundByTheLaw) {
  const double v = GetParam();
  const Trajectory run = run_with(
      *lammps, viscoelastic_impact(2e-3 / v + 0.01),
      {{Vec3(-radius - 1e-3, 0, 0), Vec3(v / 2, 0, 0)}, {Vec3(radius + 1e-3, 0, 0), Vec3(-v / 2, 0, 0)}});
  const double after = run.end_state.velocity[1].x() - run.end_state.velocity[0].x();
  WITHIN(after / v, restitution_at(0.75, v), 5e-3, 5.8e-4);
}

TEST_P(SlowLammpsViscoelastic, AGrainReboundsFromTheEndWallByTheLaw) {
  const double v = GetParam();
  const Trajectory run = run_with(*lammps, viscoelastic_impact(2e-3 / v + 0.01),
                                  {{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(v, 0, 0)}});
  WITHIN((run.end_state.v_box - run.end_state.velocity[0].x()) / v, restitution_at(0.76, v), 5e-3, 3.3e-4);
}

TEST_P(SlowLammpsViscoelastic, AGrainReboundsFromTheSideWallByTheLaw) {
  const double v = GetParam();
  const Trajectory run = run_with(*lammps, viscoelastic_impact(2e-3 / v + 0.01),
                                  {{Vec3(0, 0.05 - radius - 1e-3, 0), Vec3(0, v, 0)}});
  WITHIN(-run.end_state.velocity[0].y() / v, restitution_at(0.76, v), 5e-3, 3.3e-4);
}

INSTANTIATE_TEST_SUITE_P(Speeds, SlowLammpsViscoelastic, testing::Values(0.03, 0.3, 1.5));

/// 20 mN up to 0.2 mm.
shakedown::Setup sticky(double seconds, double walls = 1) {
  shakedown::Setup setup = impact_of(seconds);
  add_effect(setup, "grain_cohesion", {{"force", 0.02}, {"range", 2e-4}, {"walls", walls}});
  return setup;
}

/// The relative speed after an impact with a well of the depth F d on both sides of it: in closed form for
/// impacts without duration, which the pull in the contact changes by F t / mu, 3 mm/s in 0.3 ms.
double out_of_the_well(double speed, double restitution, double reduced, double depth) {
  const double inside = speed * speed + 2 * depth / reduced,
               left = restitution * restitution * inside - 2 * depth / reduced;
  return std::sqrt(left);
}

TEST_F(LammpsContact, TwoGrainsThatAttractLoseTheDepthOfTheWell) {
  const double v = 0.2;
  const Trajectory run = run_with(
      *lammps, sticky(0.05),
      {{Vec3(-radius - 1e-3, 0, 0), Vec3(v / 2, 0, 0)}, {Vec3(radius + 1e-3, 0, 0), Vec3(-v / 2, 0, 0)}});
  const double after = run.end_state.velocity[1].x() - run.end_state.velocity[0].x();
  WITHIN(after, out_of_the_well(v, 0.75, grain_mass / 2, 0.02 * 2e-4), 3e-3, 2.2e-4);
}

/// Places and speeds as in the soft engine: free flight, well, contact, well, free flight or capture.
class SlowLammpsAttraction
    : public WithLammps,
      public testing::WithParamInterface<std::pair<const char*, std::vector<PlacedGrain>>> {};

TEST_P(SlowLammpsAttraction, IsThatOfTheSoftEngine) {
  const auto& grains = GetParam().second;
  const Trajectory run = run_with(*lammps, sticky(0.05), grains),
                   other = run_with(*soft, sticky(0.05), grains);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    EXPECT_LT((run.end_state.velocity[i] - other.end_state.velocity[i]).norm(), 5e-3) << i;  // seen: 4.4e-4
    EXPECT_LT((run.end_state.position[i] - other.end_state.position[i]).norm(), 3e-4) << i;  // seen: 1.7e-5
  }
  WITHIN(run.end_state.v_box, other.end_state.v_box, 5e-6, 2.9e-7);
  double momentum = box_mass * (run.end_state.v_box);
  for (std::size_t i = 0; i < grains.size(); ++i)
    momentum += grain_mass * (run.end_state.velocity[i].x() - grains[i].velocity.x());
  EXPECT_LT(std::abs(momentum), 1e-16);  // seen: 2.0e-17
  // The last half kick of a run that ends within a contact is of first order.
  EXPECT_LT(run.health.ledger_error, 2e-6);  // seen: 1.4e-7
}

INSTANTIATE_TEST_SUITE_P(
    Encounters, SlowLammpsAttraction,
    testing::Values(
        std::pair{"pair",
                  std::vector<PlacedGrain>{
                      {Vec3(-radius - 1e-3, 0, 0), Vec3(0.1, 0, 0)},
                      {Vec3(radius + 1e-3, 1e-3, 0), Vec3(-0.1, 0, 0)}}},
        std::pair{"end", std::vector<PlacedGrain>{{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(0.2, 0.1, 0)}}},
        std::pair{"other_end",
                  std::vector<PlacedGrain>{{Vec3(-0.05 + radius + 1e-3, 0, 0), Vec3(-0.2, 0.1, 0)}}},
        std::pair{"sides", std::vector<PlacedGrain>{{Vec3(0, 0.05 - radius - 1e-3, 0.05 - radius - 2e-3),
                                                     Vec3(0.1, 0.2, 0.2)}}},
        std::pair{"caught", std::vector<PlacedGrain>{{Vec3(-radius - 2e-4, 0, 0), Vec3(0.02, 0, 0)},
                                                     {Vec3(radius + 2e-4, 0, 0), Vec3(-0.02, 0, 0)}}}),
    [](const auto& one) { return std::string(one.param.first); });

TEST_F(SlowLammpsContact, WallsThatDoNotAttractAreLeftAlone) {
  const std::vector<PlacedGrain> grain{{Vec3(0.05 - radius - 1e-4, 0, 0), Vec3(0, 0, 0)}};
  EXPECT_EQ(run_with(*lammps, sticky(0.01, 0), grain).end_state.velocity[0].x(), 0);
  EXPECT_GT(run_with(*lammps, sticky(0.01, 1), grain).end_state.velocity[0].norm(), 0);
}

TEST(LammpsContacts, HaveNoPowerOfTheSpeed) {
  shakedown::Setup setup;
  add_effect(setup, "velocity_dependent_restitution", {{"exponent", 0.1}});
  const std::string text = message_of<InputError>([&] { make_lammps_engine()->run(setup); });
  EXPECT_NE(text.find("law = \"viscoelastic\""), std::string::npos) << text;
}

/// Attraction and friction: the torques at the side walls are those of friction alone.
TEST_F(SlowLammpsContact, AttractionBesideFrictionKeepsTheBook) {
  shakedown::Setup setup;
  setup.run.duration = 0.3;
  add_effect(setup, "grain_cohesion", {{"force", 0.02}, {"range", 2e-4}});
  add_effect(setup, "grain_friction", {{"grain_grain", 0.2}, {"grain_wall", 0.2}});
  const Trajectory run = lammps->run(setup);
  EXPECT_LT(run.health.ledger_error, 3e-6);  // seen: 2.0e-7
}

}  // namespace
