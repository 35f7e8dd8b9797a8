// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "statistic.hpp"

using namespace shakedown;

TEST(Statistics, MeanSpreadAndNumber) {
  const double gap = std::nan("");
  const Statistic four = statistic_of(std::vector<double>{1, 2, gap, 3, 4});
  EXPECT_DOUBLE_EQ(four.mean, 2.5);
  EXPECT_DOUBLE_EQ(four.sd, std::sqrt(5.0 / 3));
  EXPECT_EQ(four.n, 4);
}

TEST(Statistics, OneValueHasNoSpreadAndNoneNoMean) {
  const Statistic one = statistic_of(std::vector<double>{7});
  EXPECT_EQ(one.mean, 7);
  EXPECT_TRUE(std::isnan(one.sd));
  const Statistic none = statistic_of(std::vector<double>{std::nan("")});
  EXPECT_TRUE(std::isnan(none.mean));
  EXPECT_EQ(none.n, 0);
}
