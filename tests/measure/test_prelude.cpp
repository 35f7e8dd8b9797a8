// SPDX-License-Identifier: MIT
// The film that the guide asks for: the box at rest, pulled aside, held, let go.
#include "prelude.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

struct Film {
  double rest = 0.5, pull = 0.6, hold = 0.4;  // s
  double frequency = 1.23, damping = 0.1;     // Hz, 1/s
  double rate = 240, noise = 2e-4, tremor = 0;
  double origin = 0, phase = 0;  // of a film that begins in the motion
};

MeasuredRun filmed(const Film& film, std::uint64_t seed) {
  constexpr double amplitude = 0.1, duration = 12;
  Random random(seed, 0, Stream::camera);
  MeasuredRun run;
  run.name = "film";
  const double before = film.rest + film.pull + film.hold;
  for (int i = 0; i < static_cast<int>(duration * film.rate); ++i) {
    const double t = i / film.rate, since = t - before;
    double x = 0;
    if (since >= 0)
      x = amplitude * std::exp(-film.damping * since) *
          std::cos(2 * std::numbers::pi * film.frequency * since + film.phase);
    else if (t >= film.rest + film.pull)
      x = amplitude + film.tremor * std::sin(50 * t);
    else if (t > film.rest)
      x = amplitude * (1 - std::cos(std::numbers::pi * (t - film.rest) / film.pull)) / 2;
    run.time.push_back(t);
    run.x_box.push_back(film.origin + x + film.noise * random.normal());
  }
  return run;
}

std::optional<Prelude> seen(const Film& film, std::uint64_t seed = 1) {
  const MeasuredRun run = filmed(film, seed);
  return prelude_of(run.time, run.x_box, film.noise);
}

TEST(Prelude, RestPullAndHoldEndWithTheRelease) {
  for (const Film& film : {Film{}, Film{.rate = 60}, Film{.rate = 30}, Film{.pull = 0.3}, Film{.origin = 0.3},
                           Film{.rest = 0, .pull = 0, .hold = 0.4}, Film{.rest = 2, .hold = 3}}) {
    const double release = film.rest + film.pull + film.hold;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const auto found = seen(film, seed);
      ASSERT_TRUE(found.has_value()) << film.rate;
      WITHIN((found->release - release) * std::min(film.rate, 75.0), 0, 1.5, 1)
          << film.rate << " " << film.pull;  // frames
      WITHIN(found->held, film.hold, 0.1, 0.067);
    }
  }
}

TEST(Prelude, APullWithoutAHoldEndsWhereTheBoxTurns) {
  const auto found = seen({.hold = 0});
  ASSERT_TRUE(found.has_value());
  WITHIN(found->release, 1.1, 0.04, 2e-3);  // half a frame
}

TEST(Prelude, AFilmThatBeginsInTheMotionHasNone) {
  for (int step = 0; step < 16; ++step)
    for (const double damping : {0.0, 0.1, 0.4}) {
      const Film film{
          .rest = 0, .pull = 0, .hold = 0, .damping = damping, .phase = 2 * std::numbers::pi * step / 16};
      EXPECT_FALSE(seen(film).has_value()) << step << " " << damping;
    }
}

TEST(Prelude, ASwingThatGrowsIsNone) {
  MeasuredRun run = filmed({.rest = 0, .pull = 0, .hold = 0, .damping = -0.2}, 1);
  EXPECT_FALSE(prelude_of(run.time, run.x_box, 2e-4).has_value());
}

TEST(Prelude, TheRunIsCountedFromTheRelease) {
  Experiment experiment;
  experiment.runs.push_back(filmed({}, 3));
  shakedown::Setup empty;
  empty.grains.count = 0;
  const Experiment counted = with_releases_seen(experiment, {empty});
  const MeasuredRun& run = counted.runs[0];
  WITHIN(run.lead_in.time.front(), -1.5, 0.02, 1.9e-3);
  EXPECT_GE(run.time.front(), 0);
  WITHIN(run.x_box.front(), 0.1, 2e-3, 1.1e-4);
  ASSERT_EQ(counted.notes.size(), 1u);
  EXPECT_NE(counted.notes[0].find("release_time = \"1."), std::string::npos) << counted.notes[0];
  experiment.runs[0].release_stated = true;
  EXPECT_TRUE(with_releases_seen(experiment, {empty}).notes.empty());
}

}  // namespace
}  // namespace shakedown
