// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "effects.hpp"
#include "errors.hpp"
#include "initial_state.hpp"
#include "packing.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(InitialState, DefaultIsThePapersLayerOnTheOuterWall) {
  const State state = initial_state(shakedown::Setup{});
  ASSERT_EQ(state.size(), 37u);
  WITHIN(state.position[0].x(), 0.1075 + 0.015 - 1e-5, 5e-16, 2.8e-17);
  WITHIN(state.position[0].y(), -0.01775, 8e-17, 4e-18);
  WITHIN(state.position[36].x(), 0.1075 + 0.015 - 1e-5 - 0.0142, 5e-16, 2.5e-17);  // 18 + 18 + 1
  const double spring = physics_of(shakedown::Setup{}).stiffness * 0.1075 * 0.1075 / 2;
  WITHIN(kinetic_energy(state, 0.434) / spring, 2e-5, 8e-20, 4.5e-21);
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

namespace {

/// Deepest overlap of two grains, or of a grain and a wall, m.
double deepest_overlap(const shakedown::Setup& setup, const State& state) {
  const Vec3 half(setup.box.length / 2, setup.box.width[0] / 2, setup.box.width[1] / 2);
  double deepest = 0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 centre = state.position[i] - Vec3(state.x_box, 0, 0);
    deepest = std::max(deepest, (centre.cwiseAbs().array() + state.radius[i] - half.array()).maxCoeff());
    for (std::size_t j = 0; j < i; ++j)
      deepest = std::max(deepest,
                         state.radius[i] + state.radius[j] - (state.position[i] - state.position[j]).norm());
  }
  return deepest;
}

shakedown::Setup unequal(double deviation) {
  shakedown::Setup setup;
  set_number(setup, "grain_polydispersity.relative_deviation", deviation, all_effects());
  return setup;
}

}  // namespace

// Dust in a large cell: a lattice of 1e14 sites, of which none is written down but those that are filled.
TEST(InitialState, RandomCellsHoldDustToo) {
  shakedown::Setup setup;
  setup.domain = Domain::closed;
  setup.release.packing = Packing::random;
  setup.grains.diameter = 1e-6;
  const State state = initial_state(setup);
  ASSERT_EQ(std::ssize(state.position), setup.grains.count);
  Vec3 least = state.position.front(), most = least;
  for (const Vec3& centre : state.position) least = least.cwiseMin(centre), most = most.cwiseMax(centre);
  const Vec3 cell(setup.box.length, setup.box.width[0], setup.box.width[1]);
  EXPECT_TRUE(((most - least).array() < cell.array()).all());
  EXPECT_TRUE(((most - least).array() > 0.7 * cell.array()).all());  // of 37 that lie anywhere
}

TEST(InitialState, SquareLayersOfOneGrainAcrossLeaveEveryOtherLayerEmpty) {
  for (const std::array<double, 2> width : {std::array{0.0205, 0.0205}, {0.05, 0.015}, {0.01, 0.03}}) {
    shakedown::Setup setup;
    setup.release.packing = Packing::square;
    setup.box.length = 0.104;
    setup.box.width = width;
    setup.grains.count = 6;
    const State state = initial_state(setup);
    ASSERT_EQ(state.size(), 6u);
    EXPECT_LE(deepest_overlap(setup, state), 1e-15);
    setup.grains.count = 100;
    EXPECT_THROW(initial_state(setup), InputError);
  }
}

TEST(InitialState, UnequalGrainsNeitherOverlapNorStickOut) {
  for (const Domain domain : {Domain::damper, Domain::closed})
    for (const double width : {0.0102, 0.011, 0.05}) {
      shakedown::Setup setup = unequal(0.05);
      setup.domain = domain;
      setup.box.length = 0.2;
      setup.box.width = {width, 0.05};
      setup.grains.count = 15;
      for (int run = 0; run < 5; ++run) {
        try {
          EXPECT_LE(deepest_overlap(setup, initial_state(setup, run)), 1e-15) << width;
        } catch (const InputError& error) {
          EXPECT_LT(width, 0.02) << error.what();
        }
      }
    }
  shakedown::Setup narrow = unequal(0.05);
  narrow.grains.count = 15;
  narrow.box.width = {0.01, 0.05};
  EXPECT_THROW(initial_state(narrow), InputError);
  shakedown::Setup dense = unequal(0.1);  // 64 % of a cell
  dense.domain = Domain::periodic;
  dense.grains.count = 108;
  dense.box.length = dense.box.width[0] = dense.box.width[1] = 0.0445;
  EXPECT_THROW(initial_state(dense), InputError);
}

// Without it every run of an ensemble would be the same, and no model would ever lie within its own spread.
TEST(InitialState, MeasuredGrainsDifferFromRunToRunInWhatNobodyMeasured) {
  shakedown::Setup setup;
  setup.release.initial_grains = std::string(TEST_DATA) + "/init_damper_L40.csv";
  const auto speed = [](const State& state) {
    double sum = 0;
    for (const Vec3& v : state.velocity) sum += v.squaredNorm();
    return std::sqrt(sum / static_cast<double>(state.size()));
  };
  EXPECT_EQ(initial_state(setup, 0).velocity, initial_state(setup, 1).velocity);
  setup.release.grains_measured_at = setup.release.displacement;
  const State a = initial_state(setup, 0), b = initial_state(setup, 1);
  EXPECT_EQ(a.position, b.position);
  EXPECT_NE(a.velocity, b.velocity);
  WITHIN(speed(a) / speed(b), 1, 0.002, 2.9e-4);  // known to a thousandth; seen: 2e-5

  const ScratchFolder folder;
  const std::string still = (folder / "still.csv").string();
  std::ofstream out(still);
  out << "id,x,y,z,vx,vy,vz\n";
  for (std::size_t i = 0; i < a.size(); ++i)
    out << i + 1 << ',' << a.position[i].x() << ',' << a.position[i].y() << ',' << a.position[i].z()
        << ",0,0,0\n";
  out.close();
  setup.release.initial_grains = still;
  EXPECT_NE(initial_state(setup, 0).velocity, initial_state(setup, 1).velocity);
  shakedown::Setup packed = setup;
  packed.release.initial_grains.clear();  // the same energy as in a packing
  WITHIN(speed(initial_state(setup, 0)) / speed(initial_state(packed, 0)), 1, 4e-15, 2.3e-16);
}

// A box seen to start 0.2 mm from where it was said to be has its grains with it: 16 of them would stick out.
TEST(InitialState, MeasuredGrainsMoveWithTheBoxToAnotherPlaceOfRelease) {
  shakedown::Setup setup;
  setup.box.length = 0.104;
  setup.release.initial_grains = std::string(TEST_DATA) + "/init_damper_L104.csv";
  setup.release.grains_measured_at = setup.release.displacement;
  const State measured = initial_state(setup);
  const std::string before = digest(setup);
  setup.release.displacement -= 0.2e-3;
  const State seen = initial_state(setup);
  for (std::size_t i = 0; i < seen.size(); ++i)
    WITHIN(seen.position[i].x() - seen.x_box, measured.position[i].x() - measured.x_box, 3e-16, 2.8e-17);
  EXPECT_EQ(seen.pushed_apart, 0);

  shakedown::Setup said_so = setup;  // nobody moved them
  said_so.release.grains_measured_at = said_so.release.displacement;
  EXPECT_THROW(initial_state(said_so), InputError);
  EXPECT_NE(digest(setup), digest(said_so));
  EXPECT_NE(digest(setup), before);
}

// Positions are measured of grains that were taken for equal; in a model with unequal ones they may not
// overlap.
TEST(InitialState, UnequalGrainsAtMeasuredPositionsArePushedApart) {
  for (const double deviation : {0.01, 0.05, 0.1})
    for (int run = 0; run < 100; ++run) {  // of 3000 one in eight was refused at 0.1
      shakedown::Setup setup = unequal(deviation);
      setup.release.initial_grains = std::string(TEST_DATA) + "/init_damper_L40.csv";
      const State state = initial_state(setup, run);
      EXPECT_LE(deepest_overlap(setup, state), 1e-12) << deviation << ' ' << run;
    }
}

// Grains pushed back from the wall, and nothing else to relax: they may come to lie in others.
TEST(InitialState, GrainsSlightlyUnequalDoNotOverlapBehindTheWall) {
  for (const double deviation : {5e-4, 2e-3, 5e-3})
    for (int run = 0; run < 100; ++run) {
      const shakedown::Setup setup = unequal(deviation);
      EXPECT_LE(deepest_overlap(setup, initial_state(setup, run)), 1e-15) << deviation << ' ' << run;
    }
}

TEST(InitialState, ABoxHardlyWiderThanAGrainHoldsIt) {
  for (const Packing packing : {Packing::random, Packing::spread}) {
    shakedown::Setup setup;
    setup.release.packing = packing;
    setup.box.length = 0.2;
    setup.box.width = {0.010001, 0.05};
    setup.grains.count = 20;
    EXPECT_LE(deepest_overlap(setup, initial_state(setup)), 1e-15);
  }
}

// A hundred million grains take seconds.
TEST(InitialState, PackingStopsWhenItIsAsked) {
  const std::atomic<bool> stop{true};
  stop_packing_when(&stop);
  for (const Packing packing : {Packing::fcc, Packing::square, Packing::random, Packing::spread}) {
    shakedown::Setup setup;
    setup.grains.count = 5;
    setup.release.packing = packing;
    EXPECT_THROW(initial_state(setup), Interrupted) << static_cast<int>(packing);
  }
  shakedown::Setup fluid;
  fluid.domain = Domain::periodic;
  for (const Packing packing : {Packing::fcc, Packing::random}) {
    fluid.release.packing = packing;
    EXPECT_THROW(initial_state(fluid), Interrupted);
  }
  stop_packing_when(nullptr);
  EXPECT_EQ(initial_state(fluid).size(), 37u);
}
