// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "decay.hpp"
#include "frame_motion.hpp"
#include "random.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

constexpr double frequency = 1.23, slip = 1.05e-3, release = 0.1075, shortest = 0.2 / frequency;

/// Dry friction: every |peak| is 2 slip below the one before.
double swing(double t) {
  const int n = static_cast<int>(2 * frequency * t);
  const double side = n % 2 == 0 ? 1 : -1;
  return side * slip +
         side * (release - (2 * n + 1) * slip) * std::cos(std::numbers::pi * (2 * frequency * t - n));
}

FrameMotion filmed(double rate, double phase, double noise, std::uint64_t seed, double middle = 0) {
  Random random(seed, 0, Stream::camera);
  std::vector<double> time, x;
  for (int i = 0; i < static_cast<int>(12 * rate); ++i) {
    time.push_back((i + phase) / rate);
    x.push_back(middle + swing(time.back()) + noise * random.normal());
  }
  return frame_motion(time, x, middle, shortest);
}

TEST(FrameMotion, PeaksAreRightFromTenFramesAPeriodOn) {
  for (const double rate : {12.5, 13.0, 15.0, 20.0, 24.0, 25.0, 30.0, 50.0, 60.0, 120.0, 250.0, 500.0})
    for (const double noise : {0.0, 2e-4}) {
      double worst = 0, worst_slope = 0, worst_frequency = 0;
      for (int k = 0; k < 10; ++k) {
        const FrameMotion motion = filmed(rate, 0.1 * k, noise, static_cast<std::uint64_t>(k));
        ASSERT_GE(motion.peaks.size(), 28u) << rate << ' ' << motion.why_not;
        for (std::size_t n = 0; n < 20; ++n)
          worst = std::max(worst, std::abs(std::abs(motion.peaks[n].position) -
                                           (release - 2 * static_cast<double>(n + 1) * slip)));
        worst_slope = std::max(
            worst_slope,
            std::abs(decay_of(motion.peaks, small_share * release).linear.slope + 4 * slip * frequency));
        worst_frequency = std::max(worst_frequency, std::abs(motion.frequency - frequency));
      }
      std::printf("%5.1f Hz, noise %.1f mm: peaks off by %.3f mm, slope by %.3f mm/s, frequency by %.5f Hz\n",
                  rate, noise * 1e3, worst * 1e3, worst_slope * 1e3, worst_frequency);
      EXPECT_LT(worst, noise > 0 ? 0.01 * release : 2e-4) << rate;  // seen: 0.5 mm, 0.08 mm
      EXPECT_LT(worst_slope, 1e-4) << rate;                         // m/s; seen: 4e-5
      EXPECT_LT(worst_frequency, 1e-3) << rate;                     // seen: 3.4e-4
    }
}

TEST(FrameMotion, FewerFramesAreRefusedWithTheReason) {
  const FrameMotion motion = filmed(10, 0, 0, 1);
  EXPECT_TRUE(motion.peaks.empty());
  EXPECT_NE(motion.why_not.find("8.1 frames a period"), std::string::npos) << motion.why_not;
}

TEST(FrameMotion, SwingsAboutAnyMiddle) {
  const FrameMotion motion = filmed(60, 0.3, 0, 1, 3.14);
  ASSERT_GE(motion.peaks.size(), 4u);
  WITHIN(motion.peaks[0].position, -(release - 2 * slip), 2e-5, 3.7e-6);
}

TEST(FrameMotion, OfNothingSaysSo) {
  EXPECT_FALSE(frame_motion({}, {}, 0, shortest).why_not.empty());
  EXPECT_FALSE(frame_motion({0, 1, 2}, {1, NAN, 1}, 0, shortest).why_not.empty());
}

}  // namespace
}  // namespace shakedown
