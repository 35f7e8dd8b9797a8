// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "camera_features.hpp"
#include "effects.hpp"
#include "features.hpp"
#include "setup_file.hpp"
#include "steady_forcing.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

double parabola(double t) { return 0.05 - 0.3 * t + 0.2 * t * t; }

MeasuredRun parabolic_run(double rate, int every_lost) {
  MeasuredRun run;
  run.frame_rate = rate;
  for (int k = 0; k < static_cast<int>(3 * rate); ++k) {
    if (every_lost > 0 && k % every_lost == 1) continue;
    run.time.push_back(k / rate);
    run.x_box.push_back(parabola(run.time.back()));
  }
  run.x_com = run.x_box;
  return run;
}

Measurement::Run with_audit(const MeasuredRun& run) {
  RunAudit audit;
  audit.frame_interval = 1 / run.frame_rate;
  audit.box.standard_deviation = 2e-4;
  audit.com.standard_deviation = 5e-4;
  audit.x_box = run.x_box;
  audit.x_com = run.x_com;
  return {run, audit, {}};
}

TEST(Features, AreTheLevelsAtTheMiddleOfTheBinsWhateverFramesAreLost) {
  for (const double rate : {500.0, 250.0, 100.0})
    for (const int lost : {0, 7, 3}) {
      const Measurement::Run run = with_audit(parabolic_run(rate, lost));
      const FeaturePlan plan = plan_features(run);
      const Eigen::VectorXd values = measured_features(plan, run);
      ASSERT_GT(values.size(), 20);
      for (Eigen::Index f = 0; f < values.size(); ++f)
        // rounding: 7e-16
        WITHIN(values[f], parabola(plan.features[static_cast<std::size_t>(f)].time), 9e-15, 4.5e-16)
            << rate << " Hz";
    }
}

TEST(Features, SimulationsAreReadAtTheMeasuredFrames) {
  const Measurement::Run run = with_audit(parabolic_run(250, 5));
  const FeaturePlan plan = plan_features(run);
  Recording recording;
  for (int k = 0; k <= 1500; ++k) {
    recording.time.push_back(k / 500.0);
    recording.x_box.push_back(parabola(recording.time.back()));
  }
  recording.x_com = recording.x_box;
  const Eigen::VectorXd difference = simulated_features(plan, recording) - measured_features(plan, run);
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-14);
}

// A damper that is twice as fast, filmed twice as fast, is looked at in the same frames.
TEST(Features, GoWithTheDampersPeriodAndRelease) {
  const Measurement::Run run = with_audit(parabolic_run(250, 5));
  Measurement::Run fast = run;
  for (double& t : fast.recorded.time) t /= 2;
  fast.recorded.frame_rate *= 2, fast.audit.frame_interval /= 2, fast.period /= 2;
  const FeaturePlan plan = plan_features(run), of_fast = plan_features(fast);
  ASSERT_GT(plan.features.size(), 10u);
  ASSERT_EQ(of_fast.features.size(), plan.features.size());
  for (std::size_t f = 0; f < plan.features.size(); ++f) {
    EXPECT_EQ(2 * of_fast.features[f].time, plan.features[f].time);  // halves are exact
    EXPECT_EQ(of_fast.readings[f].time.size(), plan.readings[f].time.size());
  }
  Measurement::Run far = run;  // what is rest beside a release ten times as far
  far.excursion *= 10;
  EXPECT_LE(plan_features(far).end, plan.end);
}

TEST(Features, NoiseOfABinFallsWithItsFrames) {
  const FeaturePlan plan = plan_features(with_audit(parabolic_run(500, 0)));
  // The level of a parabola at the middle of n even frames has 9/4 of the variance of a mean.
  WITHIN(plan.features[3].noise, 2e-4 * std::sqrt(2.25 / 50), 5e-8, 2.9e-9);
}

/// Every frame of one feature with every frame of another.
double wander_covariance_of(const FeaturePlan::Reading& a, const FeaturePlan::Reading& b,
                            const Wander& wander) {
  double sum = 0;
  for (std::size_t i = 0; i < a.time.size(); ++i)
    for (std::size_t k = 0; k < b.time.size(); ++k)
      sum += a.weight[i] * b.weight[k] * std::exp(-std::abs(a.time[i] - b.time[k]) / wander.time);
  return wander.deviation * wander.deviation * sum;
}

TEST(Features, ATrackThatWandersMakesThemVaryTogether) {
  const Wander wander{5e-5, 0.3};
  double worst = 0;
  for (const double rate : {500.0, 240.0}) {
    MeasuredFeatures run;
    run.plan = plan_features(with_audit(parabolic_run(rate, 7)));
    run.values = Eigen::VectorXd::Zero(std::ssize(run.plan.features));
    std::vector<MeasuredFeatures> measured{run};
    add_wander(wander, measured);
    const Eigen::MatrixXd covariance = measured.front().own * measured.front().own.transpose();
    const std::vector<Feature>& features = run.plan.features;
    for (std::size_t a = 0; a < features.size(); ++a)
      for (std::size_t b = 0; b < features.size(); ++b) {
        const double expected = features[a].observable == features[b].observable
                                    ? wander_covariance_of(run.plan.readings[a], run.plan.readings[b], wander)
                                    : 0;
        worst = std::max(
            worst,
            std::abs(covariance(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) - expected));
      }
  }
  EXPECT_LT(worst, 1e-22);  // m^2, of 2.5e-9; seen: 5.4e-24
  std::vector<MeasuredFeatures> without(1);
  add_wander({}, without);
  EXPECT_EQ(without.front().own.size(), 0);
}

/// A box that rings down within 6 s, filmed for 20.
Measurement a_ring_down(const shakedown::Setup& setup) {
  Experiment experiment;
  MeasuredRun run;
  run.frame_rate = 250;
  for (int k = 0; k < 20 * 250; ++k) {
    const double t = k / 250.0;
    run.time.push_back(t);
    run.x_box.push_back(0.1 * std::exp(-t) * std::cos(7.7 * t));
  }
  run.x_com = run.x_box;
  experiment.runs.push_back(run);
  return measurement_of(setup, experiment, all_effects());
}

TEST(Features, AModelThatShakesTheDamperChangesNotWhatIsLookedAt) {
  const shakedown::Setup shaken = parse_setup(
      "[[effect]]\nname = \"oscillating_acceleration\"\namplitude = [\"10 mm/s^2\", \"0 m/s^2\", \"0 "
      "m/s^2\"]\nfrequency = \"1.4 Hz\"\n",
      "test", all_effects());
  const Measurement as_given = a_ring_down({});
  const FeaturePlan plan = plan_features(as_given.runs.front());
  EXPECT_LT(plan.end, 6);
  const Measurement beside = with_setup(as_given, shaken, all_effects());
  ASSERT_TRUE(is_shaken(beside.runs.front().setup));
  EXPECT_EQ(plan_features(beside.runs.front()).end, plan.end);
  EXPECT_EQ(plan_features(beside.runs.front()).features.size(), plan.features.size());
  // Who says that it was shaken wants the whole film looked at.
  EXPECT_GT(plan_features(a_ring_down(shaken).runs.front()).end, 19.9);
}

}  // namespace
