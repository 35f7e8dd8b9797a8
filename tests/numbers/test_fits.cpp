// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "interpolation.hpp"
#include "least_squares.hpp"
#include "local_polynomial.hpp"
#include "running_statistic.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(Interpolation, FollowsStraightLinesAndEndsWithTheSamples) {
  const std::vector<double> places{0, 1, 3}, values{10, 20, 0};
  EXPECT_EQ(interpolated(places, values, 0), 10);
  EXPECT_EQ(interpolated(places, values, 0.25), 12.5);
  EXPECT_EQ(interpolated(places, values, 2.5), 5);
  EXPECT_EQ(interpolated(places, values, 3), 0);
  EXPECT_TRUE(std::isnan(interpolated(places, values, -1e-9)));
  EXPECT_TRUE(std::isnan(interpolated(places, values, 3.001)));
  EXPECT_TRUE(std::isnan(interpolated(places, values, std::nan(""))));
  EXPECT_TRUE(std::isnan(interpolated({}, {}, 0)));
}

TEST(RunningStatistic, IsTheStatisticOfTheValues) {
  const std::vector<double> values{1e9 + 1, 1e9 + 4, std::nan(""), 1e9 + 4, 1e9 + 7};
  RunningStatistic running;
  EXPECT_TRUE(std::isnan(running.statistic().mean));
  for (const double value : values) running.add(value);
  const Statistic found = running.statistic(), expected = statistic_of(values);
  EXPECT_EQ(found.n, 4);
  EXPECT_EQ(found.mean, 1e9 + 4);
  EXPECT_DOUBLE_EQ(found.sd, std::sqrt(6));  // a sum of squares less the square of the sum would find none
  EXPECT_DOUBLE_EQ(found.sd, expected.sd);
}

// The same points by QR of all columns at once and by normal equations point by point: two ways to one fit.
TEST(LocalPolynomial, IsTheLeastSquaresFitOfItsPowers) {
  const Eigen::ArrayXd places = even_places(4);
  Eigen::VectorXd values(9);
  values << 3, 1, 4, 1, 5, 9, 2, 6, 5;
  LocalPolynomial<4> cubic;
  for (Eigen::Index i = 0; i < places.size(); ++i) cubic.add(places[i], values[i]);
  const Eigen::MatrixXd columns = powers_of(places, 4);
  EXPECT_EQ(columns.col(0), Eigen::VectorXd::Ones(9));
  EXPECT_EQ(places[0], -1);
  EXPECT_EQ(places[5], 0.25);
  EXPECT_EQ(columns.col(3), (places * places * places).matrix()) << "quarters have exact cubes";
  const Eigen::VectorXd expected = least_squares_coefficients(columns, values);
  const Eigen::MatrixXd weights = least_squares_weights(columns);
  EXPECT_EQ(cubic.count(), 9);
  for (int i = 0; i < 4; ++i) {
    WITHIN(cubic.coefficients()[i], expected[i], 8e-15, 4.5e-16);
    WITHIN(cubic.covariance()(i, i), weights.row(i).squaredNorm(), 2e-14, 1.2e-15);
  }
}

TEST(LeastSquares, LineWithErrorsByHand) {
  Eigen::MatrixXd columns(4, 2);
  columns << 1, 0, 1, 1, 1, 2, 1, 3;
  const LeastSquares fit = least_squares(columns, Eigen::Vector4d(1, 3, 2, 4));
  WITHIN(fit.coefficients[0], 1.3, 2e-15, 2.9e-16);
  WITHIN(fit.coefficients[1], 0.8, 2e-15, 1.8e-16);
  WITHIN(fit.rms, std::sqrt(1.8 / 4), 2e-15, 1.5e-16);
  // variance 0.9; (X'X)^-1 = [[0.7, -0.3], [-0.3, 0.2]]
  const double expected[] = {0.7, -0.3, -0.3, 0.2};
  for (int i = 0; i < 4; ++i) WITHIN(fit.covariance(i / 2, i % 2), 0.9 * expected[i], 2e-15, 4.5e-16);
  WITHIN(fit.errors[1], std::sqrt(0.18), 1.5e-15, 9.4e-17);
  EXPECT_TRUE(std::isnan(least_squares(columns.topRows(2), Eigen::Vector2d(1, 3)).errors[0]));
}

TEST(LeastSquares, CoefficientsAloneAndByWeightsAreTheSame) {
  Eigen::MatrixXd columns(5, 2);
  columns << 1, -2, 1, -1, 1, 0, 1, 1.5, 1, 4;
  Eigen::VectorXd values(5);
  values << 3, 1, 4, 1, 5;
  const Eigen::VectorXd expected = least_squares(columns, values).coefficients;
  EXPECT_EQ(least_squares_coefficients(columns, values), expected);
  const Eigen::VectorXd weighted = least_squares_weights(columns) * values;
  for (int i = 0; i < 2; ++i) WITHIN(weighted[i], expected[i], 5e-15, 4.5e-16);
}

TEST(LeastSquares, ShortestCoefficientsOfColumnsThatDepend) {
  // 2 a + 4 b = 10: the shortest is along (2, 4).
  const Eigen::MatrixXd columns{{2, 4}, {1, 2}, {3, 6}};
  const Eigen::VectorXd found = shortest_coefficients(columns, Eigen::Vector3d(10, 5, 15));
  WITHIN(found[0], 1, 4e-15, 3.4e-16);
  WITHIN(found[1], 2, 4e-15, 4.5e-16);
  const Eigen::MatrixXd inverse = pseudo_inverse(columns);
  EXPECT_EQ(inverse.rows(), 2);
  const Eigen::MatrixXd again = columns * inverse * columns;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 2; ++k) WITHIN(again(i, k), columns(i, k), 1e-14, 1.8e-15);
}
