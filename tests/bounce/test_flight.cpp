// SPDX-License-Identifier: MIT
#include "flight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "errors.hpp"
#include "restitution_law.hpp"
#include "viscoelastic_contact.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(SphereDrag, IsStokesSlowlyAndNewtonFast) {
  WITHIN(sphere_drag_coefficient(1e-3) * 1e-3 / 24, 1, 0.02, 1.4e-3);
  WITHIN(sphere_drag_coefficient(1e5), 0.49, 0.02, 1.8e-3);
}

TEST(Flight, WithoutAirIsAParabola) {
  const Flight flight(9.81);
  EXPECT_DOUBLE_EQ(flight.duration(2.4525), 0.5);
  EXPECT_DOUBLE_EQ(flight.landing(2.4525), 2.4525);
  EXPECT_DOUBLE_EQ(flight.takeoff(0.5), 2.4525);
  EXPECT_DOUBLE_EQ(flight.fall(1), std::sqrt(2 * 9.81));
}

TEST(Flight, InvertsItself) {
  const Flight flight(9.81, 0.11);
  const Flight ball = BallFlights({2.7e-3, 0.04}, 9.81).at(1.1);
  for (const double v : {0.05, 0.9, 2.3, 6.0})
    for (const Flight& one : {flight, ball}) {
      WITHIN(one.takeoff(one.duration(v)) / v, 1, 2e-13, 1.1e-14);
      WITHIN(one.fall(one.height(v)) / one.landing(v), 1, 4e-15, 2.3e-16);
    }
}

/// The equation of motion in small steps, drag coefficient at each moment's Reynolds number.
TEST(BallFlights, AgreeWithTheEquationOfMotion) {
  const double mass = 2.7e-3, diameter = 0.04, displaced = air_density * M_PI / 6 * std::pow(diameter, 3),
               inertia = mass + displaced / 2, weight = 9.81 * (mass - displaced) / inertia;
  const auto rate = [&](double v) {
    const double speed = std::abs(v) + 1e-12;
    const double drag = 0.5 * air_density * M_PI / 4 * diameter * diameter *
                        sphere_drag_coefficient(air_density * speed * diameter / air_viscosity) / inertia;
    return -weight - drag * speed * v;
  };
  double v = 2.3, y = 0, t = 0;
  const double h = 1e-5;
  while (true) {
    const double k1 = rate(v), k2 = rate(v + h / 2 * k1), k3 = rate(v + h / 2 * k2), k4 = rate(v + h * k3);
    const double next_y = y + h * v + h * h / 6 * (k1 + k2 + k3);
    if (next_y < 0) break;
    y = next_y, v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), t += h;
  }
  t += -y / v;
  const Flight flight = BallFlights({mass, diameter}, 9.81).at(1);
  WITHIN(flight.duration(2.3) / t, 1, 1e-7, 6.5e-9);
  WITHIN(flight.landing(2.3) / -v, 1, 1e-4, 1.2e-5);
}

TEST(BallFlights, AHeavyBallFliesAsInVacuum) {
  const Flight flight = BallFlights({1000, 0.04}, 9.81).at(1);
  WITHIN(flight.duration(3) * 9.81 / 6, 1, 1e-7, 8e-9);
  WITHIN(flight.landing(3) / 3, 1, 2e-6, 1.4e-7);
}

TEST(BallFlights, RefuseABalloon) { EXPECT_THROW(BallFlights({1e-5, 0.3}, 9.81), InputError); }

TEST(RestitutionLaws, AreThoseOfTheEffects) {
  const double power[] = {0.8, 0.1};
  EXPECT_DOUBLE_EQ(restitution(LawKind::power, power, 0.6, 0.3), 0.8 * std::pow(2, -0.1));
  EXPECT_DOUBLE_EQ(restitution(LawKind::power, power, 1e-5, 0.3), 0.98);
  EXPECT_DOUBLE_EQ(restitution(LawKind::plastic, power, 0.6, 0.3), 0.8 * std::pow(2, -0.25));
  WITHIN(restitution(LawKind::viscoelastic, power, 0.3, 0.3), 0.8, 3e-15, 1.8e-16);
  EXPECT_DOUBLE_EQ(restitution(LawKind::viscoelastic, power, 0.6, 0.3),
                   viscoelastic_restitution(viscoelastic_damping(0.8) * std::pow(2, 0.2)));
}
