// SPDX-License-Identifier: MIT
#include "law_choice.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bounce_answer.hpp"
#include "errors.hpp"
#include "made_drops.hpp"
#include "row_covariance.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

const std::vector<double> usual_speeds{4, 3.2, 2.6, 4.2, 3.1};

BounceAnswer answer_of(const MadeBall& ball, std::uint64_t run, const BounceOptions& options = {}) {
  Random random(11, run, Stream::hidden);
  return choose_law(made_drops(ball, usual_speeds, 8, random), options);
}

}  // namespace

TEST(RowCovariance, IsTheCovarianceOfItsRows) {
  MadeBall ball;
  Random random(3, 1, Stream::other);
  const std::vector<Drop> drops = made_drops(ball, {3, 2}, 6, random);
  BounceModel model;
  const Linearised at = linearised(usable_flights(drops, {}), model, Eigen::VectorXd::Constant(1, 0.85));
  const RowCovariance covariance(at.rows);
  const Eigen::Index n = std::ssize(at.rows);
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const ImpactRow &a = at.rows[static_cast<std::size_t>(i)], &b = at.rows[static_cast<std::size_t>(j)];
      if (a.flights != b.flights) continue;
      for (Eigen::Index k = 0; k < 3; ++k)
        if (const Eigen::Index l = i + k - j; l >= 0 && l < 3)
          full(i, j) +=
              2.0 * a.instants[static_cast<std::size_t>(k)] * b.instants[static_cast<std::size_t>(l)];
      if (i == j) full(i, j) += 0.3 * a.per_restitution * b.per_restitution;
    }
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  const BandRoot root = covariance.divided({2.0, 0.3}, one);
  const Eigen::MatrixXd inverse = covariance.divided_back({2.0, 0.3}, root.columns);
  EXPECT_LT((inverse * full - one).cwiseAbs().maxCoeff(), 1e-13);  // seen: 1e-14
  WITHIN(root.log_determinant, std::log(full.determinant()), 4e-13, 2e-14);
}

TEST(LawChoice, FindsAConstantExactly) {
  MadeBall ball;
  ball.timing = 1e-7;
  const BounceAnswer answer = answer_of(ball, 1);
  EXPECT_EQ(answer.best().model.law, LawKind::constant);
  WITHIN(answer.best().values[0].value, 0.85, 2e-7, 1.1e-8);
  EXPECT_TRUE(answer.outliers.empty());
}

TEST(LawChoice, TellsThePowerFromTheConstant) {
  MadeBall ball{LawKind::power, {0.8, 0.08}};
  ball.timing = 1e-4, ball.scatter = 0.003;
  const BounceAnswer answer = answer_of(ball, 2);
  EXPECT_EQ(answer.best().model.law, LawKind::power);
  EXPECT_TRUE(answer.holds());
  EXPECT_GT(answer.scatter_odds, 0.95);
}

TEST(LawChoice, ACurveOfNoLawIsNone) {
  MadeBall ball{LawKind::curve, {0.8, 0.05, 0.03}};  // rises with the speed
  ball.timing = 1e-4, ball.scatter = 0.003;
  const BounceAnswer answer = answer_of(ball, 3);
  EXPECT_EQ(answer.best().model.law, LawKind::curve);
  EXPECT_FALSE(answer.holds());
}

TEST(LawChoice, TheAirIsTakenOff) {
  MadeBall ball{LawKind::viscoelastic, {0.93}};
  ball.flight = BallFlights({2.7e-3, 0.04}, 9.81).at(1);
  ball.timing = 5e-5;
  BounceOptions options;
  options.ball = {2.7e-3, 0.04};
  options.reference = 2;
  const BounceAnswer answer = answer_of(ball, 4, options);
  EXPECT_EQ(answer.best().model.law, LawKind::viscoelastic);
  WITHIN(answer.best().values[0].value, 0.93, 6e-4, 3.1e-5);
  EXPECT_TRUE(answer.best().values[0].low < 0.93 && 0.93 < answer.best().values[0].high);
}

TEST(SlowLawChoice, NamesAnEdgeThatWasHit) {
  MadeBall ball;
  ball.timing = 1e-4, ball.scatter = 0.004;
  Random random(11, 5, Stream::hidden);
  std::vector<Drop> drops = made_drops(ball, usual_speeds, 8, random);
  for (std::size_t i = 4; i < 8; ++i) drops[2].interval[i] *= 0.94;  // impact 5 of the third drop
  drops[1].interval[2] += 0.006, drops[1].interval[3] -= 0.006;      // a late instant: impact 4 of the second
  const BounceAnswer answer = choose_law(drops, {});
  ASSERT_EQ(answer.outliers.size(), 2u);
  for (const Outlier& outlier : answer.outliers) {
    EXPECT_EQ(outlier.impact, outlier.drop == 2 ? 5 : 4);
    EXPECT_EQ(outlier.kind, outlier.drop == 2 ? OutlierKind::impact : OutlierKind::instant);
  }
}

TEST(LawChoice, AKnownHeightAddsAnImpact) {
  MadeBall ball;
  ball.timing = 1e-4;
  Random random(11, 6, Stream::hidden);
  std::vector<Drop> drops{made_drop(ball, std::sqrt(2 * 9.81 * 1.0), 2, random)};
  EXPECT_THROW(choose_law(drops, {}), InputError);  // one ratio tells no spread
  drops[0].height = 1;
  const BounceAnswer answer = choose_law(drops, {});
  EXPECT_EQ(answer.best().at.rows.size(), 2u);
  WITHIN(answer.fastest, 4.43, 0.01, 5.6e-4);
}

TEST(LawChoice, MissedAndExtraInstantsAreNamed) {
  MadeBall ball;
  ball.timing = 1e-4, ball.scatter = 0.004;
  Random random(11, 7, Stream::hidden);
  std::vector<Drop> drops = made_drops(ball, usual_speeds, 8, random);
  std::vector<double>& missed = drops[0].interval;
  missed[3] += missed[4];
  missed.erase(missed.begin() + 4);
  drops[0].impact.pop_back();
  std::vector<double>& extra = drops[3].interval;
  extra.insert(extra.begin() + 2, 0.4 * extra[2]);
  extra[3] *= 0.6;
  drops[3].impact.push_back(9);
  const std::vector<Outlier> gross = gross_outliers(drops);
  ASSERT_EQ(gross.size(), 2u);
  EXPECT_EQ(gross[0].kind, OutlierKind::missed);
  EXPECT_EQ(gross[0].impact, 4);
  EXPECT_EQ(gross[1].kind, OutlierKind::extra);
  EXPECT_EQ(gross[1].impact, 4);
}

TEST(SlowBounceAnswer, WritesWhatASetupReads) {
  MadeBall ball{LawKind::power, {0.8, 0.08}};
  ball.timing = 1e-4, ball.scatter = 0.004;
  Random random(11, 8, Stream::hidden);
  ReadDrops read;
  read.drops = made_drops(ball, usual_speeds, 8, random);
  const BounceReading reading = weigh_drops(read, {});
  const std::string lines = known_lines(reading, "grain_wall");
  EXPECT_NE(lines.find("[known]\n\"restitution.grain_wall\" = \"0."), std::string::npos) << lines;
  EXPECT_NE(lines.find("\"velocity_dependent_restitution.exponent\" = \"0.0"), std::string::npos) << lines;
  EXPECT_NE(lines.find("\"velocity_dependent_restitution.reference_speed\" = \""), std::string::npos)
      << lines;
  EXPECT_NE(lines.find("# name = \"fluctuating_restitution\""), std::string::npos) << lines;
  EXPECT_EQ(bounce_json(reading)["law"], "power");
  EXPECT_NE(bounce_text(reading).find("by the law power"), std::string::npos);
}
