// SPDX-License-Identifier: MIT
// Elastic spheres in equilibrium: pressure and collision rate against the equation of state of Kolafa, Labik
// and Malijevsky (Phys. Chem. Chem. Phys. 6, 2335, 2004), and motion that runs backwards.
#include <gtest/gtest.h>

#include <cstdio>

#include "ensemble.hpp"
#include "fluid.hpp"
#include "initial_state.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

struct Equation {
  double packing_fraction, compressibility;  ///< Z = p V / (N k T)
};

/// Measures in blocks, compares both with the equation of state within four standard errors and
/// `finite_size`, relative.
void measure(int grains, const Equation& equation, int melting, int blocks, int per_block,
             double finite_size) {
  HardSphereSystem system(periodic_fluid(grains, equation.packing_fraction));
  system.advance_impacts(static_cast<std::int64_t>(melting) * grains / 2);
  const double kT = temperature(system.state()), n = grains;
  MeanOfRuns pressure, rate;
  for (int block = 0; block < blocks; ++block) {
    const double time = system.time(), virial = system.virial();
    const auto impacts = system.collisions()[0];
    system.advance_impacts(static_cast<std::int64_t>(per_block) * grains / 2);
    const double elapsed = system.time() - time;
    pressure.add(1 + (system.virial() - virial) / (3 * n * kT * elapsed));
    rate.add(2 * static_cast<double>(system.collisions()[0] - impacts) / (n * elapsed) / std::sqrt(kT));
  }
  const double expected_rate = rate_per_excess_pressure * (equation.compressibility - 1);
  std::printf("packing fraction %.1f, N = %d: Z %.5f +- %.5f (%.5f), impacts per grain %.5f +- %.5f (%.5f)\n",
              equation.packing_fraction, grains, pressure.mean(), pressure.error(), equation.compressibility,
              rate.mean(), rate.error(), expected_rate);
  // not WITHIN: each fluid has its own standard errors, and its size; they are bounded below
  EXPECT_NEAR(pressure.mean(), equation.compressibility,
              4 * pressure.error() + finite_size * equation.compressibility);
  // not WITHIN: likewise
  EXPECT_NEAR(rate.mean(), expected_rate, 4 * rate.error() + finite_size * expected_rate);
  EXPECT_LT(rate.error(), 0.005 * expected_rate);  // the test must be able to fail
  EXPECT_LE(system.health().deepest_overlap, 1e-12);
  system.observe();
  EXPECT_LE(system.health().ledger_error, 1e-12);
}

TEST(ElasticFluid, HasThePressureAndRateOfTheEquationOfState) {
  measure(1372, {0.3, 3.983824}, 30, 10, 20, 2e-3);
}

class SlowElasticFluid : public ::testing::TestWithParam<Equation> {};

TEST_P(SlowElasticFluid, HasThePressureAndRateOfTheEquationOfState) {
  measure(10976, GetParam(), 60, 10, 30, 5e-4);
}

INSTANTIATE_TEST_SUITE_P(PackingFractions, SlowElasticFluid,
                         ::testing::Values(Equation{0.1, 1.52165}, Equation{0.3, 3.98382},
                                           Equation{0.5, 13.0166}),
                         [](const auto& tested) {
                           return std::to_string(std::lround(tested.param.packing_fraction * 100));
                         });

State backwards(State state) {
  for (Vec3& velocity : state.velocity) velocity = -velocity;
  state.v_box = -state.v_box;
  return state;
}

/// Largest distance between where grains are and where they started, nearest images.
double largest_distance(const State& a, const State& b, const Vec3& cell) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    Vec3 apart = a.position[i] - b.position[i];
    for (int axis = 0; axis < 3; ++axis) apart[axis] = std::remainder(apart[axis], cell[axis]);
    largest = std::max(largest, apart.norm());
  }
  return largest;
}

/// Runs on for a few impacts a grain, turns every velocity round, runs back; returns the largest distance
/// from the start.
double there_and_back(const shakedown::Setup& setup, const State& start, double impacts_per_grain,
                      const Vec3& cell) {
  HardSphereSystem there(setup, start);
  there.advance_impacts(std::lround(impacts_per_grain * static_cast<double>(start.size()) / 2));
  const double halfway = there.time() * (1 + 1e-9);  // between two impacts
  EXPECT_TRUE(there.advance_to(halfway));
  HardSphereSystem back(setup, backwards(there.state()));
  back.advance_to(halfway);
  EXPECT_EQ(back.collisions(), there.collisions());
  return largest_distance(back.state(), start, cell);
}

TEST(TimeReversal, BringsAFluidBackToItsStart) {
  for (const double packing_fraction : {0.1, 0.3, 0.5}) {
    const shakedown::Setup setup = periodic_fluid(1372, packing_fraction);
    HardSphereSystem melting(setup);
    melting.advance_impacts(20 * 686);
    melting.advance_to(melting.time() * (1 + 1e-9));  // between two impacts
    const double off = there_and_back(setup, melting.state(), 3, Vec3::Constant(setup.box.length));
    std::printf("packing fraction %.1f: %.1e diameters from the start\n", packing_fraction, off);
    EXPECT_LE(off, 1e-9);  // diameters
  }
}

TEST(TimeReversal, BringsAnElasticDamperBackToItsStart) {
  shakedown::Setup setup;
  setup.restitution = {1.0, 1.0};
  setup.release.packing = Packing::spread;
  const double off = there_and_back(setup, initial_state(setup), 3, Vec3::Constant(1e9));
  std::printf("damper: %.1e m from the start\n", off);
  EXPECT_LE(off, 1e-9);  // metre
}

}  // namespace
