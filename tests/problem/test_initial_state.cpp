// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "initial_state.hpp"

using namespace shakedown;

TEST(InitialState, DefaultIsThePapersLayerOnTheOuterWall) {
  const State state = initial_state(shakedown::Setup{});
  ASSERT_EQ(state.size(), 37u);
  EXPECT_NEAR(state.position[0].x(), 0.1075 + 0.015 - 1e-5, 1e-15);
  EXPECT_NEAR(state.position[0].y(), -0.01775, 1e-15);
  EXPECT_NEAR(state.position[36].x(), 0.1075 + 0.015 - 1e-5 - 0.0142, 1e-15);  // 18 + 18 + 1
  const double spring = physics_of(shakedown::Setup{}).stiffness * 0.1075 * 0.1075 / 2;
  EXPECT_NEAR(kinetic_energy(state, 0.434) / spring, 2e-5, 1e-18);
}

TEST(InitialState, RunsDifferInVelocityAndRepeat) {
  const State first = initial_state(shakedown::Setup{}, 0), second = initial_state(shakedown::Setup{}, 1),
              again = initial_state(shakedown::Setup{}, 1);
  EXPECT_NE(first.velocity[0], second.velocity[0]);
  EXPECT_EQ(second.velocity[5], again.velocity[5]);
}

TEST(InitialState, EveryPackingIsFreeOfOverlapInEveryBoxOfThePaper) {
  for (const double length : {0.040, 0.065, 0.085, 0.104, 0.311})
    for (const Packing packing : {Packing::fcc, Packing::square, Packing::random, Packing::spread}) {
      shakedown::Setup setup;
      setup.box.length = length;
      setup.release.packing = packing;
      const State state = initial_state(setup, 3);
      for (std::size_t i = 0; i < state.size(); ++i) {
        EXPECT_LE(std::abs(state.position[i].x() - state.x_box), (length - 0.01) / 2);
        for (std::size_t j = 0; j < i; ++j) EXPECT_GE((state.position[i] - state.position[j]).norm(), 0.01);
      }
    }
}

TEST(InitialState, RandomCellsHoldAllGrainsWithoutOverlapAcrossTheirFaces) {
  shakedown::Setup setup;
  setup.domain = Domain::periodic;
  setup.release.packing = Packing::random;
  setup.grains.count = 450;
  setup.box.length = 0.083;
  setup.box.width = {0.081, 0.079};  // packing fraction 0.44
  const State state = initial_state(setup), other = initial_state(setup, 1);
  ASSERT_EQ(state.size(), 450u);
  EXPECT_NE(state.position, other.position);
  const Vec3 cell(0.083, 0.081, 0.079);
  for (std::size_t i = 0; i < state.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      Vec3 apart = state.position[i] - state.position[j];
      for (int axis = 0; axis < 3; ++axis) apart[axis] = std::remainder(apart[axis], cell[axis]);
      EXPECT_GE(apart.norm(), 0.01);
    }
  setup.grains.count = 900;
  EXPECT_THROW(initial_state(setup), InputError);
}
