// SPDX-License-Identifier: MIT
// The covariance that weighs features: how well it tells simulations that it has not seen.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

#include "engines.hpp"
#include "feature_covariance.hpp"
#include "random.hpp"

using namespace shakedown;

namespace {

/// Box and centre of the paper's damper at 104 mm at every tenth of a second, simulations x features, m: the
/// hard engine's motion is smooth, so that neighbours know of each other.
Eigen::MatrixXd simulated(int runs) {
  const auto engine = engine_named("hard");
  shakedown::Setup setup;
  setup.box.length = 0.104;
  setup.run.duration = 6;
  setup.run.sample_rate = 10;
  Eigen::MatrixXd rows;
  for (int run = 0; run < runs; ++run) {
    RunOptions options;
    options.run = run;
    const Trajectory trajectory = engine->run(setup, options);
    const auto count = std::ssize(trajectory.x_box) - 1;  // not the release, which is the same in all
    rows.conservativeResize(runs, 2 * count);
    for (Eigen::Index k = 0; k < count; ++k) {
      rows(run, k) = trajectory.x_box[static_cast<std::size_t>(k + 1)];
      rows(run, count + k) = trajectory.x_com[static_cast<std::size_t>(k + 1)];
    }
  }
  return rows;
}

Eigen::MatrixXd without_mean(const Eigen::MatrixXd& rows) {
  return (rows.rowwise() - rows.colwise().mean()) *
         std::sqrt(static_cast<double>(rows.rows()) / static_cast<double>(rows.rows() - 1));
}

FeaturePlan plan_of(Eigen::Index features, double noise) {
  FeaturePlan plan;
  for (Eigen::Index f = 0; f < features; ++f)
    plan.features.push_back({Observable::box, 0.1 * static_cast<double>(f), noise});
  return plan;
}

Eigen::MatrixXd shrunk(const Eigen::MatrixXd& rows, double noise, double shrinkage) {
  Eigen::MatrixXd covariance = rows.transpose() * rows / static_cast<double>(rows.rows());
  const Eigen::VectorXd variance = covariance.diagonal();
  covariance *= 1 - shrinkage;
  covariance.diagonal() += shrinkage * variance;
  covariance.diagonal().array() += noise * noise;
  return covariance;
}

/// ln of the likelihood of one unseen simulation as a camera of this noise films it, on average.
double told(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& unseen, double noise) {
  const Eigen::LLT<Eigen::MatrixXd> root(covariance);
  const Eigen::MatrixXd inverse = root.solve(Eigen::MatrixXd::Identity(covariance.rows(), covariance.cols()));
  const double determinant = 2 * Eigen::MatrixXd(root.matrixL()).diagonal().array().log().sum(),
               squares = (unseen * inverse).cwiseProduct(unseen).sum() / static_cast<double>(unseen.rows());
  return -(determinant + squares + noise * noise * inverse.trace()) / 2;
}

}  // namespace

// Found from the simulations alone, as good as the best that those which were not seen would have chosen.
TEST(SlowFeatureCovariance, TellsUnseenSimulationsAsTheBestShrinkageOfAGridDoes) {
  const double noise = 4e-5;
  const Eigen::MatrixXd all = simulated(600), unseen = without_mean(all.bottomRows(400));
  for (const int runs : {64, 128, 200}) {
    const Eigen::MatrixXd seen = without_mean(all.topRows(runs));
    double best = -1e300;
    for (const double shrinkage : {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0})
      best = std::max(best, told(shrunk(seen, noise, shrinkage), unseen, noise));
    const double found = told(feature_covariance(seen, plan_of(seen.cols(), noise), 0), unseen, noise),
                 fixed = told(shrunk(seen, noise, 0.4), unseen, noise);
    EXPECT_GT(found, best - 40) << runs;   // half of 64 asks for more shrinkage than all; seen: 24, 10, 11
    EXPECT_GT(found, fixed + 40) << runs;  // seen: 82, 139, 143
  }
}

TEST(FeatureCovariance, OfIndependentFeaturesHasNoCorrelations) {
  constexpr Eigen::Index features = 150;
  Eigen::MatrixXd rows(60, features);
  Random random(3, 1, Stream::other);
  for (double& one : rows.reshaped()) one = 1e-4 * random.normal();
  const Eigen::MatrixXd covariance = feature_covariance(rows, plan_of(features, 1e-6), 0);
  const Eigen::VectorXd variance = covariance.diagonal();
  const Eigen::MatrixXd others = covariance - Eigen::MatrixXd(variance.asDiagonal());
  EXPECT_LT(others.norm(), 0.1 * covariance.norm());
}
