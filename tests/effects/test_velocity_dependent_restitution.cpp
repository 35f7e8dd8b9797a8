// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "effects.hpp"
#include "physics.hpp"
#include "random.hpp"
#include "setup_file.hpp"
#include "viscoelastic_contact.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

Physics physics_with(const std::vector<Override>& overrides) {
  return physics_of(parse_setup("", "s", all_effects(), overrides));
}
const std::string effect = "velocity_dependent_restitution.";

/// One impact under the law's push by small steps of its own (midpoint rule): restitution and duration.
struct Impact {
  double restitution, duration, energy_error;
};
Impact impact(const Physics& physics, ContactClass kind, double speed, double mass) {
  const double step = physics.soft_contact_time / 20000;
  double overlap = 0, rate = speed, time = 0, dissipated = 0;
  const double kinetic = mass * speed * speed / 2;
  double last_force = 0;
  do {
    const double force = physics.contact.push(kind, overlap, rate, speed, mass);
    const double middle = overlap + rate * step / 2, middle_rate = rate - force / mass * step / 2;
    last_force = physics.contact.push(kind, middle, middle_rate, speed, mass);
    overlap += middle_rate * step;
    rate -= last_force / mass * step;
    time += step;
    // What the force exceeds the elastic one is the dashpot's.
    dissipated += (last_force - 2.5 * physics.contact.stored_energy(kind, middle, speed, mass) / middle) *
                  middle_rate * step;
  } while (last_force > 0);
  const double left = physics.contact.stored_energy(kind, overlap, speed, mass);
  return {-rate / speed, time, (mass * rate * rate / 2 + left + dissipated - kinetic) / kinetic};
}

}  // namespace

TEST(ViscoelasticContact, FollowsThePublishedSeriesForSmallLosses) {
  for (const double b : {1e-4, 3e-4, 1e-3}) {
    const double series = 1 - 1.15344 * b + 0.79826 * b * b;  // Ramirez et al. 1999, their C1 and C2
    const double left_out = 6 * b * b * b + 1e-5 * b;
    WITHIN((solved_viscoelastic_restitution(b) - series) / left_out, 0, 1, 0.86) << b;
  }
  EXPECT_EQ(solved_viscoelastic_restitution(0), 1);
}

TEST(ViscoelasticContact, TableFollowsTheIntegration) {
  Random random(1, 0, Stream::other);
  for (int i = 0; i < 300; ++i) {
    const double b = 36 * std::pow(random.uniform(), 3);
    WITHIN(viscoelastic_restitution(b), solved_viscoelastic_restitution(b), 1e-10, 1e-11) << b;
  }
  for (const double restitution : {0.999, 0.9, 0.75, 0.3, 0.01})
    WITHIN(viscoelastic_restitution(viscoelastic_damping(restitution)), restitution, 6e-15, 3.4e-16);
}

TEST(VelocityDependentRestitution, PowerLaw) {
  const Physics physics = physics_with({{effect + "exponent", "0.12"}});
  const auto at = [&](double speed) {
    return physics.contact.restitution_at(ContactClass::grain_grain, speed);
  };
  EXPECT_DOUBLE_EQ(at(0.3), 0.75);
  EXPECT_DOUBLE_EQ(at(0.6), 0.75 * std::pow(2, -0.12));
  EXPECT_DOUBLE_EQ(physics.contact.restitution_at(ContactClass::end_wall, 0.3), 0.76);
  EXPECT_EQ(at(1e-6), 0.98);
  EXPECT_EQ(at(0), 0.98);
  EXPECT_EQ(physics_with({{effect + "exponent", "0.12"}, {"restitution.grain_grain", "1"}})
                .contact.restitution_at(ContactClass::grain_grain, 0),
            1);
  EXPECT_FALSE(physics.contact.push) << "the soft engine's linear spring serves";
}

TEST(VelocityDependentRestitution, ViscoelasticLawHoldsTheSetupsValueAtTheReferenceSpeed) {
  const Physics physics = physics_with({{effect + "law", "viscoelastic"}});
  WITHIN(physics.contact.restitution_at(ContactClass::grain_grain, 0.3), 0.75, 4e-15, 2.3e-16);
  WITHIN(physics.contact.restitution_at(ContactClass::side_wall, 0.3), 0.76, 6e-15, 3.4e-16);
  EXPECT_EQ(physics.contact.restitution_at(ContactClass::grain_grain, 0), 1);
  // 1 - eps goes as v^(1/5) where losses are small.
  const double slow = 1 - physics.contact.restitution_at(ContactClass::grain_grain, 0.3e-10);
  const double slower = 1 - physics.contact.restitution_at(ContactClass::grain_grain, 0.3e-15);
  WITHIN(std::log10(slow / slower) / 5, 0.2, 1e-3, 1.5e-4);
}

TEST(VelocityDependentRestitution, BothViewsOfTheViscoelasticLawAgree) {
  const Physics physics = physics_with({{effect + "law", "viscoelastic"}});
  for (const double speed : {0.01, 0.3, 1.2})
    for (const double mass : {2.02e-3, 4.04e-3}) {
      const Impact seen = impact(physics, ContactClass::grain_grain, speed, mass);
      WITHIN(seen.restitution, physics.contact.restitution_at(ContactClass::grain_grain, speed), 1e-6, 5e-8)
          << speed;
      WITHIN(seen.energy_error, 0, 5e-8, 2.9e-9) << speed;
    }
}

TEST(VelocityDependentRestitution, AnElasticViscoelasticContactLastsTheContactTimeAtTheReferenceSpeed) {
  const Physics physics = physics_with({{effect + "law", "viscoelastic"}, {"restitution.grain_grain", "1"}});
  const Impact seen = impact(physics, ContactClass::grain_grain, 0.3, 2.02e-3);
  WITHIN(seen.duration / physics.soft_contact_time, 1, 1e-3, 5.1e-5);
  WITHIN(seen.restitution, 1, 4e-11, 2.2e-12);
}
