// SPDX-License-Identifier: MIT
// Where each run was let go, by the user and by its first frames.
#include <gtest/gtest.h>

#include <cmath>

#include "effects.hpp"
#include "hidden_measurements.hpp"
#include "initial_state.hpp"
#include "release_known.hpp"
#include "within.hpp"

using namespace shakedown;

// The frames lie 0.8 mm beside the release that the user gives, and a fifth at least is believed. The grains
// were measured with the box where the user had it, 0.1 mm from its wall.
TEST(ReleaseKnown, MeasuredGrainsKeepTheirPlacesInTheBox) {
  for (const double beside : {-0.8e-3, 0.8e-3}) {
    Experiment experiment = measured({{}, {}, {}, {0.104}, 3, "1 s"});
    for (MeasuredRun& run : experiment.runs) {
      run.overrides.push_back(
          {"release.initial_grains", '"' + std::string(TEST_DATA) + "/init_damper_L104.csv\"", "experiment"});
      for (std::vector<double>* track : {&run.x_box, &run.x_com})
        for (double& x : *track) x += beside;
    }
    const Measurement given = as_measured(experiment), seen = with_measured_release(given, all_effects());
    const Measurement again = with_setup(seen, believed(), all_effects());
    const State first = initial_state(given.runs[0].setup);
    for (const shakedown::Setup& setup : {seen.runs[0].setup, again.runs[0].setup}) {
      const State state = initial_state(setup);
      EXPECT_GT((state.x_box - first.x_box) / beside, 0.2);
      for (std::size_t i = 0; i < state.size(); ++i)
        WITHIN(state.position[i].x() - state.x_box, first.position[i].x() - first.x_box, 3e-16, 2.8e-17);
    }
    EXPECT_GT(seen.runs[0].recorded.release_error, 0);
  }
}
