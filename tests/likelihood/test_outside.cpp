// SPDX-License-Identifier: MIT
// What free parameters take up of a change, against the closed form of a sum of both.
#include <gtest/gtest.h>

#include "outside.hpp"

using namespace shakedown;

TEST(Outside, TellsWhatParametersTakeAndWhatTheyLeave) {
  Eigen::MatrixXd free(4, 2);
  free << 1, 1, 1, -1, 2, 0, 0, 3;
  const Eigen::ArrayXd variance = Eigen::Array4d(1, 4, 0.25, 2);
  // Orthogonal to both columns in the metric of the variances: free' diag(1/variance) left = 0.
  const Eigen::Vector2d taken(0.7, -1.3);
  Eigen::MatrixXd weighted = variance.inverse().matrix().asDiagonal() * free;
  const Eigen::Vector4d any(1, 2, -1, 0.5);
  const Eigen::VectorXd left =
      any - free * (free.transpose() * weighted).ldlt().solve(weighted.transpose() * any);
  const Outside outside(free, variance);
  EXPECT_LT((outside.taken_of(free * taken + left) - taken).norm(),
            4e-9);  // seen: 2.4e-10, of the ridge of 1e-9
  EXPECT_LT((outside(free * taken + left) - (variance.rsqrt() * left.array()).matrix()).norm(),
            1e-8);  // seen: 5.8e-10
}

TEST(Outside, NothingIsTakenWhereNothingIsFree) {
  const Outside outside(Eigen::MatrixXd(3, 0));
  EXPECT_EQ(outside.taken_of(Eigen::Vector3d(1, 2, 3)).size(), 0);
}
