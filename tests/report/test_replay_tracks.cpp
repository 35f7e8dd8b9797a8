// SPDX-License-Identifier: MIT
// The grains of the page are where the grains of the run were, within the tolerance that the page states.
#include "replay_tracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "effects.hpp"
#include "hard_engine.hpp"
#include "replay.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

double at(const std::vector<double>& time, const std::vector<double>& value, double t) {
  const auto after = std::upper_bound(time.begin(), time.end(), t);
  if (after == time.end()) return value.back();
  const auto i = static_cast<std::size_t>(after - time.begin()) - 1;
  return value[i] + (value[i + 1] - value[i]) * (t - time[i]) / (time[i + 1] - time[i]);
}

StoredRun run_with(const std::string& effects) {
  const shakedown::Setup setup =
      parse_setup("[run]\nduration = \"3 s\"\n" + effects, "test.toml", all_effects());
  RunOptions options;
  options.log_collisions = true;
  return {"", setup, 0, *make_hard_engine()->run(setup, options).collision_log};
}

/// Largest distance of a drawn grain from the simulated one at many moments, m.
double worst_distance(const StoredRun& run, const ReportReplay& drawn, double from, double to) {
  Replay replay(run.setup, run.log);
  double worst = 0;
  for (double t = from; t < to; t += 0.7e-3) {
    replay.advance_to(t);
    const State state = replay.state();
    for (std::size_t i = 0; i < state.size(); ++i) {
      const ReportReplay::Track& g = drawn.grains[i];
      worst = std::max({worst, std::abs(at(g.time, g.x, t) - state.position[i].x()),
                        std::abs(at(g.time, g.y, t) - state.position[i].y()),
                        std::abs(at(g.time, g.z, t) - state.position[i].z())});
    }
    worst = std::max(worst, std::abs(at(drawn.box.time, drawn.box.x, t) - state.x_box));
  }
  return worst;
}

}  // namespace

TEST(ReplayTracks, StayWithinTheirTolerance) {
  const StoredRun run = run_with("");
  const ReportReplay drawn = replay_of(run, {"g", "t", 0.2, 0.7, 3, 200'000, 2e-5});
  EXPECT_LE(worst_distance(run, drawn, 0, 3), drawn.tolerance + 4e-6);
}

TEST(ReplayTracks, LeaveOutNothingWhereTheyAreExact) {
  const StoredRun run = run_with("");
  const ReportReplay drawn = replay_of(run, {"g", "t", 0.2, 0.7, 3, 20'000, 1e-4});
  EXPECT_GT(drawn.tolerance, 1e-4);  // so few bytes need a coarser drawing elsewhere
  // the box bends by 3 um between its points, grains do not bend
  const double exact = worst_distance(run, drawn, 0.21, 0.69);
  std::printf("exact to %.1e m\n", exact);
  EXPECT_LE(exact, 4e-6);
}

TEST(ReplayTracks, FollowBentFlights) {
  const StoredRun run =
      run_with("[[effect]]\nname = \"constant_acceleration\"\nacceleration = {x = \"0.2 m/s^2\"}\n");
  const ReportReplay drawn = replay_of(run, {"g", "t", 0, 0, 3, 400'000, 2e-5});
  EXPECT_LE(worst_distance(run, drawn, 0, 3), drawn.tolerance + 6e-6);
}
