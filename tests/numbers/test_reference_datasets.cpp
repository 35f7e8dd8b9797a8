// SPDX-License-Identifier: MIT
// Our statistics and least squares against certified values: National Institute of Standards and Technology,
// Statistical Reference Datasets, https://www.itl.nist.gov/div898/strd. Errors are relative; -log10 of them
// is the number of right digits.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "least_squares.hpp"
#include "running_statistic.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// NumAcc2 to NumAcc4: `middle` once, then 500 times a tenth less and a tenth more. What is certified of
/// decimals holds of doubles to rounding of the input, eps middle / 0.1 of the deviation.
std::vector<double> alternating(double middle, double less, double more) {
  std::vector<double> values{middle};
  for (int i = 0; i < 500; ++i) values.insert(values.end(), {less, more});
  return values;
}

/// Both ways to a mean and a deviation.
std::vector<Statistic> statistics_of(const std::vector<double>& values) {
  RunningStatistic running;
  for (const double value : values) running.add(value);
  return {statistic_of(values), running.statistic()};
}

Eigen::MatrixXd powers(const Eigen::VectorXd& x, int highest) {
  Eigen::MatrixXd columns(x.size(), highest + 1);
  for (int k = 0; k <= highest; ++k) columns.col(k) = x.array().pow(k);
  return columns;
}

}  // namespace

TEST(ReferenceDatasets, NumericalAccuracyOfStatistics) {
  for (const Statistic& found : statistics_of({10000001, 10000003, 10000002})) {
    EXPECT_EQ(found.mean, 10000002);
    EXPECT_EQ(found.sd, 1);
  }
  for (const Statistic& found : statistics_of(alternating(1.2, 1.1, 1.3))) {
    WITHIN(found.mean / 1.2, 1, 1e-13, 9.8e-15);
    WITHIN(found.sd / 0.1, 1, 4e-14, 2.5e-15);
  }
  for (const Statistic& found : statistics_of(alternating(1000000.2, 1000000.1, 1000000.3))) {
    WITHIN(found.mean / 1000000.2, 1, 1e-14, 5.6e-16);
    WITHIN(found.sd / 0.1, 1, 4e-9, 3.6e-10);
  }
  for (const Statistic& found : statistics_of(alternating(10000000.2, 10000000.1, 10000000.3))) {
    WITHIN(found.mean / 10000000.2, 1, 1e-13, 9.8e-15);
    WITHIN(found.sd / 0.1, 1, 6e-8, 5.6e-9);
  }
}

TEST(ReferenceDatasets, NorrisStraightLine) {
  Eigen::VectorXd x(36), y(36);
  x << 0.2, 337.4, 118.2, 884.6, 10.1, 226.5, 666.3, 996.3, 448.6, 777.0, 558.2, 0.4, 0.6, 775.5, 666.9,
      338.0, 447.5, 11.6, 556.0, 228.1, 995.8, 887.6, 120.2, 0.3, 0.3, 556.8, 339.1, 887.2, 999.0, 779.0,
      11.1, 118.3, 229.2, 669.1, 448.9, 0.5;
  y << 0.1, 338.8, 118.1, 888.0, 9.2, 228.1, 668.5, 998.5, 449.1, 778.9, 559.2, 0.3, 0.1, 778.1, 668.8, 339.3,
      448.9, 10.8, 557.7, 228.3, 998.0, 888.8, 119.6, 0.3, 0.6, 557.6, 339.3, 888.0, 998.5, 778.9, 10.2,
      117.6, 228.9, 668.4, 449.2, 0.2;
  const LeastSquares line = least_squares(powers(x, 1), y);
  WITHIN(line.coefficients[0] / -0.262323073774029, 1, 1e-12, 7.3e-14);
  WITHIN(line.coefficients[1] / 1.00211681802045, 1, 8e-14, 4.3e-15);
  WITHIN(line.errors[0] / 0.232818234301152, 1, 1.5e-13, 8.9e-15);
  WITHIN(line.errors[1] / 0.429796848199937e-3, 1, 1.2e-13, 6.3e-15);
}

TEST(ReferenceDatasets, WamplerPolynomials) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(21, 0, 20);
  const LeastSquares ones = least_squares(powers(x, 5), powers(x, 5).rowwise().sum());
  const LeastSquares tenths = least_squares(powers(x, 5), powers(x / 10, 5).rowwise().sum());
  for (int k = 0; k <= 5; ++k) {
    WITHIN(ones.coefficients[k], 1, 1e-8, 7.3e-10);
    WITHIN(tenths.coefficients[k] / std::pow(0.1, k), 1, 2e-13, 1.5e-14);
  }
}

/// Not linear, "lower difficulty": steps of Gauss and Newton, each a least_squares(), from the second start.
TEST(ReferenceDatasets, MisraGrowth) {
  Eigen::VectorXd x(14), y(14);
  x << 77.6, 114.9, 141.1, 190.8, 239.9, 289.0, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0;
  y << 10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78;
  Eigen::Vector2d b(250, 5e-4);
  LeastSquares step;
  for (int i = 0; i < 12; ++i) {
    const Eigen::VectorXd left = (-b[1] * x).array().exp();
    Eigen::MatrixXd columns(14, 2);
    columns << (1 - left.array()).matrix(), (b[0] * x.array() * left.array()).matrix();
    step = least_squares(columns, y - b[0] * (1 - left.array()).matrix());
    b += step.coefficients;
  }
  WITHIN(b[0] / 238.94212918, 1, 1e-10, 7.5e-12);
  WITHIN(b[1] / 5.5015643181e-4, 1, 1e-10, 7.5e-12);
  WITHIN(step.errors[0] / 2.7070075241, 1, 2e-10, 1.5e-11);
  WITHIN(step.errors[1] / 7.2668688436e-6, 1, 5e-11, 2.6e-12);
}
