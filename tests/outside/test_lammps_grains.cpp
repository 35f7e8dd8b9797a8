// SPDX-License-Identifier: MIT
// Contacts: restitution at walls and between grains, friction, energy and momentum, beside the soft engine.
#include <cmath>

#include "lammps.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

using LammpsGrains = WithLammps;
using SlowLammpsGrains = WithLammps;

constexpr double radius = 0.005, grain_mass = 4.04e-3, box_mass = 0.434;

/// One sample at the end of `seconds`, with many steps in a contact.
shakedown::Setup impact_of(double seconds) {
  shakedown::Setup setup = resting_box();
  setup.soft.steps_per_contact = 100;
  setup.run.duration = seconds;
  setup.run.sample_rate = 1 / seconds;
  return setup;
}

TEST_F(LammpsGrains, ReboundFromTheEndWallPushesTheBox) {
  const shakedown::Setup setup = impact_of(0.01);
  const Trajectory run = run_with(*lammps, setup, {{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(0.5, 0, 0)}});
  const double grain = run.end_state.velocity.at(0).x(), box = run.end_state.v_box;
  WITHIN((box - grain) / 0.5, 0.76, 5e-3, 7.7e-4);
  WITHIN(grain_mass * grain + box_mass * box, grain_mass * 0.5, 3e-17, 1.8e-18);
  const double reduced = grain_mass * box_mass / (grain_mass + box_mass),
               lost = reduced * 0.25 / 2 * (1 - 0.76 * 0.76);
  WITHIN(run.ledger.contact_loss[1] / lost, 1, 2e-2, 2.8e-3);
  WITHIN(run.initial_energy - run.total_energy.back(), run.ledger.contact_loss[1], 8e-18, 4.4e-19);
}

TEST_F(LammpsGrains, ReboundFromASideWallLeavesTheBoxAlone) {
  shakedown::Setup setup = impact_of(0.01);
  add_effect(setup, "side_wall_restitution", {{"restitution", 0.5}});
  const Trajectory run = run_with(*lammps, setup, {{Vec3(0, 0, 0.05 - radius - 1e-3), Vec3(0, 0, 0.5)}});
  WITHIN(-run.end_state.velocity.at(0).z() / 0.5, 0.5, 1e-2, 3.5e-3);
  EXPECT_EQ(run.end_state.v_box, 0);
  EXPECT_EQ(run.ledger.contact_loss[1], 0);
}

/// The notes of a run say how far the restitution scatters with the phase of touch.
TEST_F(LammpsGrains, ScatterWithThePhaseOfTouch) {
  shakedown::Setup setup = impact_of(0.01);
  setup.domain = Domain::closed;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.2;
  setup.soft.steps_per_contact = 20.5;
  const double speed = 0.3, step = setup.soft.contact_time / setup.soft.steps_per_contact;
  std::vector<PlacedGrain> grains;
  for (int i = 0; i < 64; ++i)
    grains.push_back(
        {Vec3(0.1 - radius - 1e-3 - speed * step * i / 64, 0.02 * (i % 8) - 0.07, 0.02 * (i / 8) - 0.07),
         Vec3(speed, 0, 0)});
  const Trajectory run = run_with(*lammps, setup, grains);
  double sum = 0, most = 0;
  for (const Vec3& velocity : run.end_state.velocity) {
    const double error = -velocity.x() / speed - 0.76;
    sum += error;
    most = std::max(most, std::abs(error));
  }
  EXPECT_LT(most, 0.45 / 20.5);                // seen: 0.0163
  EXPECT_LT(std::abs(sum / 64), 0.04 / 20.5);  // seen: 0.0014
}

TEST_F(LammpsGrains, MeetAsInTheSoftEngine) {
  shakedown::Setup setup = impact_of(0.01);
  const Vec3 along = Vec3(1, 2, 2) / 3;
  const std::vector<PlacedGrain> grains{{-(radius + 1e-3) * along, 0.3 * along},
                                        {(radius + 1e-3) * along, -0.2 * along}};
  const Trajectory run = run_with(*lammps, setup, grains), other = run_with(*soft, setup, grains);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((run.end_state.velocity[i] - other.end_state.velocity[i]).norm(), 3e-3) << i;  // seen: 2.1e-4
  WITHIN(run.ledger.contact_loss[0] / other.ledger.contact_loss[0], 1, 2e-2, 3e-3);
}

/// Impacts that slide throughout, at an end wall, at the side walls, and of two grains.
class SlowLammpsFriction : public WithLammps, public testing::WithParamInterface<std::vector<PlacedGrain>> {};

TEST_P(SlowLammpsFriction, TurnsGrainsAsTheSoftEngineDoes) {
  shakedown::Setup setup = impact_of(0.01);
  add_effect(setup, "grain_friction", {{"grain_grain", 0.1}, {"grain_wall", 0.1}});
  const Trajectory run = run_with(*lammps, setup, GetParam()), other = run_with(*soft, setup, GetParam());
  EXPECT_LT((run.end_state.velocity[0] - other.end_state.velocity[0]).norm(), 1e-2);  // seen: 9.4e-4
  EXPECT_LT((run.end_state.spin[0] - other.end_state.spin[0]).norm(), 2);             // seen: 0.72
  WITHIN(run.end_state.v_box, other.end_state.v_box, 1e-4, 6.4e-6);
  for (std::size_t kind = 0; kind < contact_classes; ++kind)
    WITHIN(run.ledger.contact_loss[kind], other.ledger.contact_loss[kind], 1e-5, 7.5e-7)
        << kind;                              // seen: 7.4e-7
  EXPECT_LT(run.health.ledger_error, 2e-14);  // seen: 1.1e-15
}

INSTANTIATE_TEST_SUITE_P(
    Impacts, SlowLammpsFriction,
    testing::Values(std::vector<PlacedGrain>{{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(0.5, 0.3, 0.4)}},
                    std::vector<PlacedGrain>{{Vec3(0, 0.05 - radius - 1e-3, 0), Vec3(0.4, 0.5, 0.3)}},
                    std::vector<PlacedGrain>{{Vec3(0, 0, -0.05 + radius + 1e-3), Vec3(-0.4, 0.3, -0.5)}},
                    std::vector<PlacedGrain>{{Vec3(-radius - 1e-3, 0, 0), Vec3(0.5, 0.4, 0)},
                                             {Vec3(radius + 1e-3, 4e-4, 0), Vec3(0, 0, 0)}}));

/// A tangential spring of its own ratio, where most of the contact sticks. Without a dashpot both slide at
/// the same force.
TEST_F(LammpsGrains, GiveWaySidewaysAsInTheSoftEngine) {
  shakedown::Setup setup = impact_of(0.01);
  setup.restitution.grain_wall = 1;
  add_effect(setup, "grain_friction", {{"grain_grain", 0.5}, {"grain_wall", 0.5}, {"stiffness_ratio", 0.82}});
  const std::vector<PlacedGrain> grains{{Vec3(0.05 - radius - 1e-3, 0, 0), Vec3(0.5, 0.1, 0.1)}};
  const Trajectory run = run_with(*lammps, setup, grains), other = run_with(*soft, setup, grains);
  setup.effects.back().values["stiffness_ratio"] = ContactLaw::turning_ratio;
  const Trajectory turned = run_with(*soft, setup, grains);
  WITHIN((run.end_state.spin[0] - other.end_state.spin[0]).norm(), 0, 3, 0.3);
  EXPECT_GT((turned.end_state.spin[0] - other.end_state.spin[0]).norm(), 5);
}

TEST_F(LammpsGrains, FallAndAreDraggedAsInTheSoftEngine) {
  shakedown::Setup setup = impact_of(0.05);
  setup.soft.steps_per_contact = 20;
  add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(0.3, -0.2, 0.1)}});
  add_effect(setup, "grain_air_drag", {{"linear", 0.02}, {"quadratic", 0.02}});
  const std::vector<PlacedGrain> grains{{Vec3(0, 0, 0), Vec3(0.3, 0.1, -0.2)}};
  const Trajectory run = run_with(*lammps, setup, grains), other = run_with(*soft, setup, grains);
  EXPECT_LT((run.end_state.velocity[0] - other.end_state.velocity[0]).norm(), 1e-4);  // seen: 5.4e-6
  WITHIN(run.end_state.v_box, other.end_state.v_box, 7e-7, 3.9e-8);
  for (std::size_t i = 0; i < 2; ++i)
    WITHIN(run.ledger.effect_loss.at(i), other.ledger.effect_loss.at(i), 5e-8, 2.8e-9) << i;
}

TEST_F(SlowLammpsGrains, AreDrivenByAFormulaAsInTheSoftEngine) {
  shakedown::Setup setup = impact_of(0.05);
  add_effect(setup, "user_force",
             {{"on", std::string("grains")}, {"force", std::string("-0.3*x - 0.01*v + 2e-3*sin(40*t)")}});
  const std::vector<PlacedGrain> grains{{Vec3(0.01, 0, 0), Vec3(0.3, 0.1, -0.2)},
                                        {Vec3(-0.02, 0.02, 0), Vec3(-0.1, 0.1, 0)}};
  const Trajectory run = run_with(*lammps, setup, grains), other = run_with(*soft, setup, grains);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((run.end_state.velocity[i] - other.end_state.velocity[i]).norm(), 5e-6) << i;  // seen: 3.5e-7
  EXPECT_EQ(run.end_state.v_box, 0);
  WITHIN(run.ledger.effect_loss.at(0), other.ledger.effect_loss.at(0), 3e-9, 1.5e-10);
}

TEST_F(SlowLammpsGrains, BeginAsEveryEngineDoes) {
  shakedown::Setup setup;
  setup.run.duration = 0.3;
  const Trajectory run = lammps->run(setup, {3, {}}), other = soft->run(setup, {3, {}});
  WITHIN(run.initial_energy / other.initial_energy, 1, 1e-14, 6.7e-16);
  WITHIN(run.x_com.front(), other.x_com.front(), 1e-15, 2.1e-16);
  EXPECT_LT(largest_difference(run, other), 4e-4);  // seen: 2.2e-5
  EXPECT_LT(run.health.ledger_error, 1e-5);         // seen: 5.5e-7
  EXPECT_EQ(run.end_state.size(), 37u);
}

/// A damper whose losses are of all kinds: what is taken out is what is lost.
TEST(SlowLammps, DamperLosesWhatTheSoftOneLoses) {
  if (!has_lammps()) GTEST_SKIP() << "there is no program lmp";
  shakedown::Setup setup;
  setup.run.duration = 5;
  const Trajectory run = make_lammps_engine()->run(setup), other = make_soft_engine()->run(setup);
  for (std::size_t kind = 0; kind < contact_classes; ++kind)
    WITHIN(run.ledger.contact_loss[kind] / run.initial_energy,
           other.ledger.contact_loss[kind] / other.initial_energy, 0.03, 3e-3)
        << kind;                             // seen: 0.003
  EXPECT_LT(run.health.ledger_error, 3e-4);  // seen: 1.6e-5
}

}  // namespace
