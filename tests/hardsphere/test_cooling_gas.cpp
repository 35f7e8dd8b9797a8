// SPDX-License-Identifier: MIT
// A gas of inelastic spheres without walls cools as Haff's law says, while it stays homogeneous:
//   T = T0 / (1 + t / tau)^2,  1 / tau = (1 - eps^2) rate0 / 6 (1 + 3 a2 / 16),
// rate0 the impacts per grain and second of the elastic fluid at T0, a2 the Sonine coefficient of the scaling
// state (van Noije and Ernst, Granular Matter 1, 57, 1998). Computer experiments cool about 1 % more slowly
// (Kawahara and Nakanishi, cond-mat/0309130), and clusters grow after some tens of impacts a grain.
#include <gtest/gtest.h>

#include <cstdio>

#include "ensemble.hpp"
#include "fluid.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double restitution = 0.95, packing_fraction = std::numbers::pi / 12, compressibility = 3.269371;

double sonine_coefficient(double e) {
  return 16 * (1 - e) * (1 - 2 * e * e) / (81 - 17 * e + 30 * e * e * (1 - e));
}

/// 1 / tau from the slope of sqrt(T0 / T) - 1 through the origin, in units of sqrt(k T0 / m) / diameter.
double cooling_rate(int run, double impacts_per_grain) {
  constexpr int grains = 2048;
  shakedown::Setup setup = periodic_fluid(grains, packing_fraction);
  HardSphereSystem elastic(setup, run);
  elastic.advance_impacts(30 * grains / 2);
  setup.restitution = {restitution, restitution};
  setup.hard.pair_elastic_speed = 0;
  const State start = elastic.state();
  HardSphereSystem gas(setup, start);
  const double start_temperature = temperature(start);
  double moment = 0, square = 0;
  for (int k = 0; k < 50; ++k) {
    gas.advance_impacts(std::lround(impacts_per_grain * grains / 2 / 50));
    const double time = gas.time() * std::sqrt(start_temperature);
    moment += time * (std::sqrt(start_temperature / temperature(gas.state())) - 1);
    square += time * time;
  }
  EXPECT_EQ(gas.health().elastic_rescues, 0);
  return moment / square;
}

void compare_with_haff(int runs, Tolerance within) {
  const double law = (1 - restitution * restitution) * rate_per_excess_pressure * (compressibility - 1) / 6 *
                     (1 + 3 * sonine_coefficient(restitution) / 16);
  MeanOfRuns rate;
  for (int run = 0; run < runs; ++run) rate.add(cooling_rate(run, 20));
  std::printf("cooling rate %.5f +- %.5f, Haff's law %.5f\n", rate.mean(), rate.error(), law);
  WITHIN(rate.mean() / law, 1, within);
  EXPECT_LT(rate.error(), within.size / 4 * law);
}

TEST(CoolingGas, FollowsHaffsLaw) { compare_with_haff(4, {0.03, 9.1e-3}); }
TEST(SlowCoolingGas, FollowsHaffsLaw) { compare_with_haff(32, {0.02, 0.013}); }

}  // namespace
