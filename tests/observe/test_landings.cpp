// SPDX-License-Identifier: MIT
#include "landings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double amplitude = 0.1, frequency = 1.1, room = 0.03, length = 0.065, mass = 0.15;
const double omega = 2 * std::numbers::pi * frequency;

struct Tracks {
  std::vector<double> time, box, centre;  ///< s, m
};

/// A body that lies on a wall until the box is fastest, flies to the other wall at that speed and is brought
/// to rest there at once (restitution 0) or bounces once with `rebound` and is caught.
Tracks one_body(double frames_a_second, double rebound) {
  Tracks tracks;
  const double step = 1e-6;
  double inside = room / 2, speed = 0;  // in the box; relative
  bool flies = false, bounced = false;
  const long every = std::lround(1 / (frames_a_second * step));
  for (long i = 0; i < 6'000'000; ++i) {
    const double t = static_cast<double>(i) * step, box = amplitude * std::cos(omega * t),
                 push = omega * omega * box;  // of the frame of the box on what flies there
    if (i % every == 0) {
      tracks.time.push_back(t);
      tracks.box.push_back(box);
      tracks.centre.push_back(box + inside);
    }
    const double side = std::copysign(1, inside);
    if (!flies && push * side < 0) flies = true, bounced = false, speed = 0;
    if (!flies) continue;
    speed += push * step;
    inside += speed * step;
    if (std::abs(inside) < room / 2 || inside * speed <= 0) continue;
    inside = std::copysign(room / 2, inside);
    flies = !bounced && rebound > 0;
    speed = flies ? -rebound * speed : 0;
    bounced = true;
  }
  return tracks;
}

std::vector<Landing> seen(const Tracks& tracks) {
  return landings(tracks.time, tracks.box, tracks.centre, {length, mass, 1 / frequency});
}

}  // namespace

TEST(Landings, OfABodyThatIsCaughtGiveTwiceItsMomentum) {
  const std::vector<Landing> list = seen(one_body(2000, 0));
  ASSERT_GE(list.size(), 10u);
  for (const Landing& landing : list) {
    WITHIN(landing.momentum / (2 * mass * amplitude * omega), 1, 4e-11, 2.3e-12);
    WITHIN(landing.thickness, length - room, 8e-16, 4.2e-17);
    EXPECT_LT(std::abs(landing.rebound), 1e-15);  // rounding
    EXPECT_LT(landing.lasting, landing_window / frequency);
  }
  // It leaves where the box is fastest and comes where A (w t - sin w t) = room.
  double low = 0, high = std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    const double turn = (low + high) / 2;
    (amplitude * (turn - std::sin(turn)) < room ? low : high) = turn;
  }
  WITHIN(list[0].time, (std::numbers::pi / 2 + low) / omega, 5e-3, 1.1e-3);
  WITHIN(list[0].speed / (amplitude * omega * (1 - std::cos(low))), 1, 0.3, 0.14);
}

TEST(Landings, WithARebound) {
  const std::vector<Landing> lively = seen(one_body(2000, 0.6)), dead = seen(one_body(2000, 0));
  ASSERT_GE(lively.size(), 10u);
  EXPECT_GT(lively[0].rebound, dead[0].rebound + 0.1);
  EXPECT_GT(lively[0].thickness, dead[0].thickness);
}

TEST(Landings, NeedFiveFramesInAThirtiethOfAPeriod) {
  for (const Landing& landing : seen(one_body(100, 0))) EXPECT_TRUE(std::isnan(landing.speed));
  EXPECT_TRUE(landings({}, {}, {}, {length, mass, 1 / frequency}).empty());
}
