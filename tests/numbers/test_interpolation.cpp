// SPDX-License-Identifier: MIT
#include "interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "random.hpp"

using namespace shakedown;

// Chords of 1 and 3: the slope between them is their harmonic mean, 3/2; the parabola's slope at the first
// point is none.
TEST(MonotoneCubic, HasTheSlopesOfItsSource) {
  const std::vector<double> x{0, 1, 2}, y{0, 1, 4};
  EXPECT_DOUBLE_EQ(monotone_cubic(x, y, 0.5), 0.5 - 1.5 / 8);
  // From 3/2 at 1 to (3 * 3 - 1)/2 = 4 at 2.
  EXPECT_DOUBLE_EQ(monotone_cubic(x, y, 1.5), 2.5 + (1.5 - 4) / 8);
}

TEST(MonotoneCubic, KeepsPointsLinesAndEnds) {
  const std::vector<double> x{-1, 0, 0.5, 3}, line{1, 3, 4, 9}, y{2, 2, -1, 5};
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_DOUBLE_EQ(monotone_cubic(x, y, x[i]), y[i]);
  for (const double at : {-0.9, 0.1, 0.3, 1.0, 2.9})
    EXPECT_DOUBLE_EQ(monotone_cubic(x, line, at), 3 + 2 * at);
  EXPECT_EQ(monotone_cubic(x, y, -INFINITY), 2);
  EXPECT_EQ(monotone_cubic(x, y, 7), 5);
  EXPECT_TRUE(std::isnan(monotone_cubic(x, y, NAN)));
  EXPECT_DOUBLE_EQ(monotone_cubic(std::vector<double>{0, 2}, std::vector<double>{1, 5}, 0.5), 2);
}

TEST(MonotoneCubic, TurnsOnlyWhereThePointsDo) {
  Random random(5, 0, Stream::other);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> x{0}, y{0};
    for (int i = 0; i < 5; ++i) {
      x.push_back(x.back() + 0.01 + random.uniform());
      y.push_back(y.back() + std::pow(random.uniform(), 6));
    }
    double before = y.front();
    for (int i = 0; i <= 400; ++i) {
      const double here = monotone_cubic(x, y, x.back() * i / 400);
      EXPECT_GE(here, before - 1e-14) << trial;
      before = here;
    }
  }
}

TEST(Interpolation, IsAStraightLineAndNothingOutside) {
  const std::vector<double> x{0, 1, 3}, y{1, 2, 0};
  EXPECT_DOUBLE_EQ(interpolated(x, y, 2), 1);
  EXPECT_DOUBLE_EQ(interpolated(x, y, 3), 0);
  EXPECT_TRUE(std::isnan(interpolated(x, y, 3.1)));
  EXPECT_TRUE(std::isnan(interpolated({}, {}, 0)));
}
