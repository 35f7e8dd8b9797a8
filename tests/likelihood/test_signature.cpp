// SPDX-License-Identifier: MIT
// Signatures at levels against closed forms: a change that is known exactly, one that simulations know to an
// error, one that is no line about nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random.hpp"
#include "signature.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr Eigen::Index features = 600;

Eigen::VectorXd noise(std::uint64_t seed, double deviation = 1) {
  Random random(seed, 1, Stream::other);
  Eigen::VectorXd values(features);
  for (double& value : values) value = deviation * random.normal();
  return values;
}

/// A shape of unit length.
Eigen::VectorXd shape(double turns) {
  Eigen::VectorXd values(features);
  for (Eigen::Index f = 0; f < features; ++f)
    values[f] = std::sin(2 * std::numbers::pi * turns * static_cast<double>(f) / features);
  return values.normalized();
}

/// Means of `runs` simulations of unit chaos at each strength.
std::vector<SignatureLevel> simulated(const std::vector<double>& strengths, int runs, std::uint64_t seed,
                                      const std::function<Eigen::VectorXd(double)>& change,
                                      const Eigen::VectorXd& error_of_nothing) {
  std::vector<SignatureLevel> levels;
  for (const double strength : strengths)
    levels.push_back({strength, change(strength) + noise(seed++, 1 / std::sqrt(runs)) - error_of_nothing,
                      static_cast<double>(features) / runs});
  return levels;
}

}  // namespace

TEST(Signature, OfAnExactLineIsTheClosedForm) {
  const Eigen::VectorXd line = 20 * shape(3), residual = 0.7 * line + noise(5);
  const Signature signature({{1.0, line, 0}}, {residual, 0}, true);
  const double b = line.dot(residual), a = line.squaredNorm();
  for (const double s : {-0.4, 0.3, 0.7, 1.5})  // seen: 1e-13
    WITHIN(signature.log_likelihood(s), s * b - s * s * a / 2, 1e-12, 5.7e-14);
  const StrengthPosterior found = posterior_of(signature, {0.5, -2, 2});
  WITHIN(found.strength, b / a, 1e-3, 8.1e-5);  // a step of the sum there; seen: 4e-4
  WITHIN(found.error, 1 / std::sqrt(a), 2e-16, 1.4e-17);
  WITHIN(found.gain, b * b / a, 5e-5, 2.6e-6);
  // Laplace, the prior being wide: the largest likelihood times the share of the prior under it.
  const double share = std::sqrt(2 * std::numbers::pi / a) / (std::numbers::pi * 0.5) /
                       (1 + std::pow(b / a / 0.5, 2)) / (2 / std::numbers::pi * std::atan(4.0));
  WITHIN(found.log_evidence, b * b / a / 2 + std::log(share), 0.02, 5.5e-3);
}

TEST(Signature, IsAParabolaThroughItsLevels) {
  const Eigen::VectorXd slope = 5 * shape(2), bend = 9 * shape(5);
  const auto change = [&](double s) -> Eigen::VectorXd { return s * slope + s * s * bend; };
  const Signature signature({{0.5, change(0.5), 0}, {1, change(1), 0}, {2, change(2), 0}}, {noise(1), 0},
                            true);
  for (const double s : {-1.0, 0.1, 1.5})
    EXPECT_LT((signature.change(s) - change(s)).cwiseAbs().maxCoeff(), 1e-12);  // seen: 3e-14
}

TEST(Signature, GoesStraightFromLevelToLevelOverDecades) {
  const auto change = [](double s) -> Eigen::VectorXd {
    return 10 * s / (1 + s) * shape(2) + (s > 1 ? s - 1 : 0) * shape(5);  // saturates, then something else
  };
  std::vector<SignatureLevel> levels;
  for (const double s : {8.0, 0.1, 1.0}) levels.push_back({s, change(s), 0});
  const Signature signature(levels, {noise(1), 0}, true);
  for (const double s : {0.1, 1.0, 8.0})
    EXPECT_LT((signature.change(s) - change(s)).cwiseAbs().maxCoeff(), 1e-14) << s;  // seen: 4e-16
  EXPECT_LT((signature.change(0.05) - change(0.1) / 2).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((signature.change(4.5) - (change(1) + change(8)) / 2).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((signature.change(15) - (2 * change(8) - change(1))).cwiseAbs().maxCoeff(), 1e-14);
}

// An effect whose change has its square alone, far beyond any line about nothing, is seen at its strength.
TEST(Signature, FindsAStrengthThatNoLineAboutNothingShows) {
  const auto change = [](double s) -> Eigen::VectorXd { return 15 * s * s * shape(4); };
  const Eigen::VectorXd nothing = noise(3, 1 / std::sqrt(96)), residual = change(1.2) + noise(9) - nothing;
  const Signature signature(simulated({0.5, 1, 2}, 32, 40, change, nothing), {residual, features / 96.0});
  const StrengthPosterior found = posterior_of(signature, {1, 0, 3});
  EXPECT_GT(found.log_evidence, 100);
  WITHIN(found.strength, 1.2, 0.06, 0.019);
}

// Of many null experiments ln evidence is below zero on average, and large by no more than chance allows: the
// evidence against nothing is above e^2 in at most a share of e^-2 of them (Markov's inequality).
TEST(Signature, OfNothingIsNoEvidenceThoughItsSimulationsAreFew) {
  const auto change = [](double s) -> Eigen::VectorXd { return 6 * s * shape(4); };
  constexpr int experiments = 300;
  double sum = 0;
  int beyond = 0;
  for (int e = 0; e < experiments; ++e) {
    const auto seed = static_cast<std::uint64_t>(1000 + 10 * e);
    const Eigen::VectorXd nothing = noise(seed, 1 / std::sqrt(64));
    const Signature signature(simulated({0.5, 1, 2}, 16, seed + 1, change, nothing),
                              {noise(seed + 5) - nothing, features / 64.0});
    const double evidence = posterior_of(signature, {1, -3, 3}).log_evidence;
    sum += evidence;
    beyond += evidence > 2;
  }
  EXPECT_LT(sum / experiments, 0);        // seen: -1.1
  EXPECT_LE(beyond, 0.05 * experiments);  // seen: 5
}

TEST(PairSignature, IsTheSumOfItsParts) {
  const Eigen::VectorXd first = 15 * shape(3), second = 15 * (shape(3) + shape(7)).normalized(),
                        residual = 0.8 * first + 0.6 * second + noise(8);
  const SignatureResidual without{residual, 0};
  const Signature one({{1.0, first, 0}}, without, true), other({{1.0, second, 0}}, without, true);
  const PairSignature both(one, other);
  for (const double x : {0.0, 0.4, 1.1})
    for (const double y : {0.0, 0.7}) {
      const Eigen::VectorXd sum = x * first + y * second;
      // seen: 3e-14
      WITHIN(both.log_likelihood(x, y), sum.dot(residual) - sum.squaredNorm() / 2, 5e-13, 4.1e-14);
    }
  WITHIN(both.log_likelihood(0.4, 0), one.log_likelihood(0.4), 1e-13, 2.2e-14);
  // Each alone takes up what both share; together each has its own.
  const StrengthPrior prior{0.5, 0, 4};
  const PairPosterior found = posterior_of(one, prior, other, prior);
  WITHIN(found.first, 0.8, 0.2, 0.067);  // standard error
  WITHIN(found.second, 0.6, 0.2, 0.067);
  EXPECT_GT(posterior_of(one, prior).strength, 1);
  EXPECT_GT(found.log_evidence, posterior_of(one, prior).log_evidence + 10);
}

TEST(PairSignature, OfOneEffectIsNoBetterThanThatOne) {
  const Eigen::VectorXd there = 20 * shape(3), absent = 20 * shape(11), residual = 0.7 * there + noise(9);
  const SignatureResidual without{residual, 0};
  const Signature one({{1.0, there, 0}}, without, true), other({{1.0, absent, 0}}, without, true);
  const StrengthPrior prior{0.5, 0, 4};
  EXPECT_LT(posterior_of(one, prior, other, prior).log_evidence, posterior_of(one, prior).log_evidence);
}

TEST(PairSignature, TakesOffTheNoiseThatBothShareOnce) {
  // Nothing there: the mean without them errs, and both changes have that error.
  double sum = 0;
  constexpr int cases = 40, runs = 12;
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    const Eigen::VectorXd error = noise(1000 + seed, 1 / std::sqrt(runs)),
                          residual = noise(2000 + seed) - error;
    const SignatureResidual without{residual, static_cast<double>(features) / runs};
    const auto none = [](double) { return Eigen::VectorXd(Eigen::VectorXd::Zero(features)); };
    const Signature one(simulated({1}, runs, 3000 + 10 * seed, none, error), without),
        other(simulated({1}, runs, 5000 + 10 * seed, none, error), without);
    sum += PairSignature(one, other).log_likelihood(1, 1);
  }
  WITHIN(sum / cases, 0, 1, 0.056);
}

TEST(Signature, WhatIsNoNumberIsNoEvidence) {
  Eigen::VectorXd residual = noise(1);
  residual[7] = std::nan("");
  EXPECT_TRUE(
      std::isnan(posterior_of(Signature({{1.0, shape(1), 0}}, {residual, 0}), {1, -1, 1}).log_evidence));
}

TEST(Signature, TheShareSeenIsThatOfTheSquareWithoutNoise) {
  const Eigen::VectorXd line = 10 * shape(3);
  const double nu = 50;
  const Signature signature({{1.0, line, nu}}, {0.5 * line, 0}, false);
  const double square = line.squaredNorm() - nu;
  // As long as the residual leaves less than one a feature, straight: the same at every strength.
  for (const double s : {0.2, 1.0, 1.7})
    WITHIN(signature.share_seen(s), square / (square + nu), 2e-15, 1.2e-16);
  EXPECT_EQ(Signature({{1.0, line, 200}}, {line, 0}).share_seen(1), 0);
}
