// SPDX-License-Identifier: MIT
#include "robust_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(RobustStatistics, MedianAndDeviationIgnoreOutliers) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
  const double gap = std::nan("");
  EXPECT_EQ(median({gap, 3, gap, gap, 1, 2, gap}), 2);
  EXPECT_TRUE(std::isnan(median({gap, gap})));
  Random random(1, 0, Stream::other);
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) values.push_back(i % 20 == 0 ? 1e3 : 2 * random.normal());
  WITHIN(robust_deviation(values), 2, 0.2, 0.12);  // 5 % outliers widen it by 7 %
}
