// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "random.hpp"
#include "robust_statistics.hpp"

namespace shakedown {
namespace {

TEST(Statistics, ChiSquaredTail) {
  // Two degrees of freedom: exp(-x/2). Others: tables of Abramowitz and Stegun 26.8.
  for (const double x : {0.1, 1.0, 9.0, 60.0})
    EXPECT_NEAR(chi_squared_tail(x, 2) / std::exp(-x / 2), 1, 1e-13);
  EXPECT_NEAR(chi_squared_tail(3.841458820694124, 1), 0.05, 1e-14);
  EXPECT_NEAR(chi_squared_tail(124.34211340400407, 100), 0.05, 1e-12);
  EXPECT_EQ(chi_squared_tail(0, 5), 1);
  EXPECT_NEAR(chi_squared_tail(800, 800), 0.4934, 2e-4);
}

TEST(Statistics, NormalQuantileInvertsTheTail) {
  for (const double z : {0.0, 0.3, 1.959963984540054, 5.0})
    EXPECT_NEAR(normal_quantile(1 - normal_two_sided_tail(z) / 2), z, 1e-8);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-12);
}

TEST(Statistics, MedianAndRobustDeviation) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
  Random random(1, 0, Stream::other);
  std::vector<double> values;
  for (int i = 0; i < 20000; ++i) values.push_back(i % 20 == 0 ? 1e3 : 2 * random.normal());
  EXPECT_NEAR(robust_deviation(values), 2, 0.2);  // 5 % outliers widen it by 7 %
}

}  // namespace
}  // namespace shakedown
