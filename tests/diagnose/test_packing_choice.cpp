// SPDX-License-Identifier: MIT
// How the grains lay before release, from their recorded centre.
#include <gtest/gtest.h>

#include "effects.hpp"
#include "hidden_measurements.hpp"
#include "packing_choice.hpp"
#include "random.hpp"

using namespace shakedown;

TEST(PackingChoice, ABiasOfTheCameraIsNotTakenForAPacking) {
  const Experiment experiment = measured({{"camera_com_bias=bias:0.08"}, {}, {}, {0.040, 0.104}});
  EXPECT_EQ(packing_before_release(believed(), as_measured(experiment), all_effects()).packing,
            believed().release.packing);
}

// Half way between the layers of fcc and of square.
TEST(PackingChoice, AnArrangementThatNoPackingHasIsTold) {
  Experiment experiment = measured({{}, {}, {}, {0.040}});
  const auto chosen = [&] {
    return packing_before_release(believed(), as_measured(experiment), all_effects());
  };
  EXPECT_TRUE(chosen().fits);
  for (MeasuredRun& run : experiment.runs)
    for (double& x : run.x_com) x -= 1e-3;
  EXPECT_FALSE(chosen().fits);
  EXPECT_EQ(chosen().packing, believed().release.packing);
}

// Up to a camera's scale layers of fcc and of square lie some 0.6 mm apart; 0.2 mm is the error of a dozen
// frames of a bad camera.
TEST(SlowPackingChoice, LayersAreToldFromEachOtherThroughNoise) {
  for (const Packing truth : {Packing::fcc, Packing::square}) {
    const Experiment clean = measured({{},
                                       {{"release.packing", truth == Packing::fcc ? "fcc" : "square"}},
                                       {},
                                       {0.040, 0.040, 0.065, 0.085, 0.104},
                                       5,
                                       "0.5 s"});
    for (std::uint64_t draw = 0; draw < 50; ++draw) {
      Experiment experiment = clean;
      Random random(draw, 0, Stream::other);
      for (MeasuredRun& run : experiment.runs) {
        const double wrong = 0.2e-3 * random.normal();
        for (double& x : run.x_com) x += wrong;
      }
      EXPECT_EQ(packing_before_release(believed(), as_measured(experiment), all_effects()).packing, truth)
          << draw;
    }
  }
}

// One draw against another differs by sqrt(2) times what one differs from the mean, and was called no
// packing.
TEST(PackingChoice, GrainsLaidAtRandomAreKnownAsThat) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Experiment experiment =
        measured({{}, {{"release.packing", "random"}}, {}, {0.040, 0.040}, seed, "0.2 s"});
    const PackingChoice choice = packing_before_release(believed(), as_measured(experiment), all_effects());
    EXPECT_EQ(choice.packing, Packing::random) << seed;
    EXPECT_TRUE(choice.fits) << seed << ": " << choice.apart;
  }
}

TEST(PackingChoice, SoManyGrainsThatAnotherPackingCannotHoldThem) {
  Experiment experiment = measured({{}, {}, {}, {0.040}, 5, "0.2 s"});
  shakedown::Setup setup = believed();
  setup.grains.count = 80;
  const PackingChoice choice = packing_before_release(setup, as_measured(experiment), all_effects());
  EXPECT_EQ(choice.packing, setup.release.packing);
  EXPECT_FALSE(choice.fits);
}
