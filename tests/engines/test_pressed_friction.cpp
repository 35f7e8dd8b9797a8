// SPDX-License-Identifier: MIT
// Grains that rub in a layer pressed on a wall: there impulses and soft contacts differ most, and what the
// hard engine does about inelastic collapse shows in the first strokes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "effects.hpp"
#include "ensemble.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"
#include "soft_engine.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(SlowPressedFriction, LosesInTheFirstStrokesWhatSoftContactsLose) {
  const shakedown::Setup setup = parse_setup(R"(
    [spring]
    frequency = "1.225444 Hz"
    [restitution]
    grain_grain = 0.66088
    grain_wall = 0.68664
    [run]
    duration = "2.2 s"
    [[effect]]
    name = "grain_friction"
    grain_grain = 0.4137
    grain_wall = 0.4137
  )",
                                             "strong friction", all_effects());
  EnsembleOptions options;
  options.runs = 16;
  const Ensemble hard = run_ensemble(*make_hard_engine(), setup, options);
  // The soft engine with contacts of 0.05 ms, 32 runs: errors 0.015, 0.015, 0.024, 0.027 mm. Impacts made
  // elastic without friction gave 103.48, 99.33, 95.17, 91.01 mm.
  constexpr std::array<double, 4> soft{103.709e-3, 99.631e-3, 95.633e-3, 91.586e-3};
  for (std::size_t k = 0; k < soft.size(); ++k) {
    const Statistic peak =
        hard.over_runs([&](const RunResult& run) { return std::abs(run.observables.peaks.at(k).position); });
    WITHIN(peak.mean, soft[k], 0.25e-3, 0.16e-3) << k;  // m
  }
}

// Smooth walls have no tangential spring that could store what slips along them.
TEST(PressedFriction, OfGrainsAloneOrOfWallsAloneNeverAddsEnergy) {
  for (const char* rubbing : {"grain_grain", "grain_wall"}) {
    const shakedown::Setup setup =
        parse_setup("[run]\nduration = \"0.1 s\"\n[[effect]]\nname = \"grain_friction\"\n" +
                        std::string(rubbing) + " = 0.4\n",
                    rubbing, all_effects());
    const Trajectory run = make_soft_engine()->run(setup, {});
    for (const double energy : run.total_energy)
      EXPECT_LE(energy, run.initial_energy * (1 + 1e-9)) << rubbing;
  }
}
