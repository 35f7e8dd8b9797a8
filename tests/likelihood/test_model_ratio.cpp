// SPDX-License-Identifier: MIT
// Two models of one recording, by means and spreads, against the densities of normal distributions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model_ratio.hpp"
#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr Eigen::Index features = 600;

Eigen::VectorXd noise(std::uint64_t seed, double deviation) {
  Random random(seed, 1, Stream::other);
  Eigen::VectorXd values(features);
  for (double& value : values) value = deviation * random.normal();
  return values;
}

Eigen::VectorXd shape(double turns) {
  Eigen::VectorXd values(features);
  for (Eigen::Index f = 0; f < features; ++f)
    values[f] = std::sin(2 * std::numbers::pi * turns * static_cast<double>(f) / features);
  return values.normalized();
}

/// Of independent features of unit variance, its mean known exactly.
FirstModel first_with(const Eigen::VectorXd& residual) {
  FirstModel first{residual, 0, Eigen::MatrixXd(features, 0), Eigen::ArrayXd::Ones(features), {}};
  first.simulations.resize(400, features);
  for (Eigen::Index i = 0; i < 400; ++i)
    first.simulations.row(i) = noise(1000 + static_cast<std::uint64_t>(i), 1).transpose();
  return first;
}

/// kappa of a change, as model_ratio.hpp defines it.
double kappa_of(const FirstModel& first, const Eigen::VectorXd& change) {
  return std::max(1.0, (first.simulations * change).squaredNorm() / 400 / change.squaredNorm());
}

}  // namespace

TEST(ModelRatio, OfMeansIsTheRatioOfTwoNormalDensities) {
  const Eigen::VectorXd change = 6 * shape(3), residual = 0.8 * change + noise(5, 1);
  const FirstModel first = first_with(residual);
  const double expected = (residual.squaredNorm() - (residual - change).squaredNorm()) / 2;
  WITHIN(log_likelihood_ratio({change, 0, first.variance}, first) * kappa_of(first, change), expected, 4e-13,
         2.4e-14);
  EXPECT_GT(expected, 5);
}

TEST(ModelRatio, OfSpreadsIsTheRatioOfTwoNormalDensities) {
  const Eigen::VectorXd residual = noise(8, 1.1), none = Eigen::VectorXd::Zero(features);
  const FirstModel first = first_with(residual);
  const double expected =
      residual.squaredNorm() / 2 * (1 - 1 / 1.21) - static_cast<double>(features) / 2 * std::log(1.21);
  const double found = log_likelihood_ratio({none, 0, Eigen::ArrayXd::Constant(features, 1.21)}, first);
  WITHIN(found, expected, 2e-13, 1.5e-14);
  EXPECT_GT(expected, 1);
}

// A mean that is far off is no spread: however large it is, a wider model gains no more by it.
TEST(ModelRatio, AMeanThatIsOffIsNoSpread) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(features);
  const Eigen::ArrayXd wider = Eigen::ArrayXd::Constant(features, 1.3);
  const auto gain = [&](double off) {
    return log_likelihood_ratio({none, 0, wider}, first_with(off * Eigen::VectorXd::Ones(features)));
  };
  WITHIN(gain(3), gain(30), 9e-12, 4.6e-13);
  EXPECT_LT(gain(3), 0.5 * 1.5 * features * (1 - 1 / 1.3));
}

// Two codes of one physics differ: what is wider everywhere says no more than how rarely they differ so much.
TEST(ModelRatio, WiderEverywhereIsWhatCodesDifferBy) {
  FirstModel first = first_with(noise(8, std::sqrt(1.25)));
  const OtherModel wider{Eigen::VectorXd::Zero(features), 0, Eigen::ArrayXd::Constant(features, 1.2)};
  EXPECT_GT(log_likelihood_ratio(wider, first), 3);
  first.codes_differ = 1.4;
  const auto away = [&](double variance) { return first.residual.squaredNorm() / features / variance - 1; };
  ASSERT_GT(away(1.2), 0);
  WITHIN(log_likelihood_ratio(wider, first), (std::pow(away(1) / 0.2, 2) - std::pow(away(1.2) / 0.2, 2)) / 2,
         5e-13, 2.7e-14);
}

// Where it is wider and where narrower does say something: the closed form of two halves.
TEST(ModelRatio, ASpreadOfAnotherShapeCountsWhateverCodesDifferBy) {
  constexpr double larger = 1.6, smaller = 0.8;
  Eigen::ArrayXd variance(features);
  variance << Eigen::ArrayXd::Constant(features / 2, larger), Eigen::ArrayXd::Constant(features / 2, smaller);
  FirstModel first = first_with((noise(8, 1).array() * variance.sqrt()).matrix());
  first.codes_differ = 1.4;
  const double n = features, by_first = first.residual.squaredNorm() / n,
               by_other = (first.residual.array().square() / variance).sum() / n;
  ASSERT_GT(by_other, 1);
  const double expected = (n * (std::log(by_first / by_other) - (std::log(larger) + std::log(smaller)) / 2) +
                           std::pow((by_first - 1) / 0.2, 2) - std::pow((by_other - 1) / 0.2, 2)) /
                          2;
  WITHIN(log_likelihood_ratio({Eigen::VectorXd::Zero(features), 0, variance}, first), expected, 1e-12,
         8.6e-14);
  EXPECT_GT(expected, 10);
}

// What a free parameter takes up is no evidence, whatever the variances are.
TEST(ModelRatio, OfWhatAFreeParameterDoesIsNothing) {
  const Eigen::VectorXd change = 7 * shape(2) - 4 * shape(3);
  FirstModel first = first_with(3 * change + noise(2, 1));
  first.free.resize(features, 2);
  first.free << shape(2), shape(3);
  for (Eigen::Index f = 0; f < features; ++f) first.variance[f] = 1 + 0.5 * std::sin(static_cast<double>(f));
  WITHIN(log_likelihood_ratio({change, 0, first.variance}, first), 0, 2e-14, 1.2e-15);
}

// Simulations that vary along the change four times as much as the metric says leave a quarter of the
// evidence.
TEST(ModelRatio, IsDividedByHowMuchWorseThanTheMetricChaosIs) {
  const Eigen::VectorXd change = 6 * shape(3), residual = change + noise(5, 1);
  const FirstModel first = first_with(residual);
  FirstModel wild = first;
  wild.simulations *= 2;
  const OtherModel other{change, 0, first.variance};
  WITHIN(kappa_of(wild, change), 4, 0.8, 0.27);
  WITHIN(log_likelihood_ratio(other, wild) * kappa_of(wild, change),
         log_likelihood_ratio(other, first) * kappa_of(first, change), 1e-12, 5.1e-14);  // rounding of chi2
}
