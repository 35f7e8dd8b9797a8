// SPDX-License-Identifier: MIT
// Where each run was let go, by the user and by its first frames.
#include <gtest/gtest.h>

#include <cmath>

#include "effects.hpp"
#include "engines.hpp"
#include "initial_state.hpp"
#include "measurements.hpp"
#include "release_known.hpp"
#include "setup_file.hpp"
#include "within.hpp"

using namespace shakedown;

// The frames lie 0.8 mm beside the release that the user gives, and a fifth at least is believed. The grains
// were measured with the box where the user had it, 0.1 mm from its wall.
TEST(ReleaseKnown, MeasuredGrainsKeepTheirPlacesInTheBox) {
  const std::unique_ptr<Engine> engine = engine_named("hard");
  const shakedown::Setup believed = parse_setup("[run]\nduration = \"1 s\"\n", "believed", all_effects());
  for (const double beside : {-0.8e-3, 0.8e-3}) {
    Experiment experiment = make_measurements(believed, runs_of_lengths({0.104}), {},
                                              {engine.get(), all_effects(), 3, 1, nullptr});
    for (MeasuredRun& run : experiment.runs) {
      run.overrides.push_back(
          {"release.initial_grains", '"' + std::string(TEST_DATA) + "/init_damper_L104.csv\"", "experiment"});
      for (std::vector<double>* track : {&run.x_box, &run.x_com})
        for (double& x : *track) x += beside;
    }
    const Measurement given = measurement_of(believed, experiment, all_effects()),
                      seen = with_measured_release(given, all_effects());
    const Measurement again = with_setup(seen, believed, all_effects());
    const State first = initial_state(given.runs[0].setup);
    for (const shakedown::Setup& setup : {seen.runs[0].setup, again.runs[0].setup}) {
      const State state = initial_state(setup);
      EXPECT_GT((state.x_box - first.x_box) / beside, 0.2);
      for (std::size_t i = 0; i < state.size(); ++i)
        WITHIN(state.position[i].x() - state.x_box, first.position[i].x() - first.x_box, 2.5e-16, 1.4e-17);
    }
    EXPECT_GT(seen.runs[0].recorded.release_error, 0);
  }
}
