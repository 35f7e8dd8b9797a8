// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "spring_dashpot.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(SpringDashpot, HalfPeriodOfItsOscillationIsTheContact) {
  const double mass = 2.02e-3, contact_time = 3e-4;
  for (const double restitution : {1.0, 0.75, 0.2}) {
    const SpringDashpot contact = spring_dashpot(restitution, mass, contact_time);
    const double decay = contact.damping / (2 * mass);
    const double rate = std::sqrt(contact.stiffness / mass - decay * decay);
    WITHIN(std::numbers::pi / rate / contact_time, 1, 4e-15, 2.3e-16);
    WITHIN(std::exp(-decay * contact_time), restitution, 4e-15, 2.3e-16);
  }
}

TEST(SpringDashpot, ConstantsOfThePapersGrains) {
  const SpringDashpot contact = spring_dashpot(0.75, 2.02e-3, 1e-3);
  WITHIN(contact.stiffness, 2.0104e4, 1, 0.23);
  WITHIN(contact.damping, 1.162, 1e-3, 2.4e-4);
}

TEST(SpringDashpot, PredictsAnErrorOfSecondOrder) {
  WITHIN(predicted_restitution_error(20), 3.1e-3, 1e-17, 6.9e-19);
  WITHIN(predicted_restitution_error(50), 5e-4, 7e-5, 4e-6);
}
