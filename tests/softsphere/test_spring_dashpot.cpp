// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "spring_dashpot.hpp"

using namespace shakedown;

TEST(SpringDashpot, HalfPeriodOfItsOscillationIsTheContact) {
  const double mass = 2.02e-3, contact_time = 3e-4;
  for (const double restitution : {1.0, 0.75, 0.2}) {
    const SpringDashpot contact = spring_dashpot(restitution, mass, contact_time);
    const double decay = contact.damping / (2 * mass);
    const double rate = std::sqrt(contact.stiffness / mass - decay * decay);
    EXPECT_NEAR(std::numbers::pi / rate / contact_time, 1, 1e-14);
    EXPECT_NEAR(std::exp(-decay * contact_time), restitution, 1e-14);
  }
}

TEST(SpringDashpot, ConstantsOfThePapersGrains) {
  const SpringDashpot contact = spring_dashpot(0.75, 2.02e-3, 1e-3);
  EXPECT_NEAR(contact.stiffness, 2.0104e4, 1);
  EXPECT_NEAR(contact.damping, 1.162, 1e-3);
}

TEST(SpringDashpot, PredictsAnErrorOfSecondOrder) {
  EXPECT_NEAR(predicted_restitution_error(20), 3.1e-3, 1e-4);
  EXPECT_NEAR(predicted_restitution_error(50), 5e-4, 1e-4);
}
