// SPDX-License-Identifier: MIT
#include "shares.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random.hpp"
#include "trial.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(Shares, WilsonsIntervalHasItsClosedFormAndStaysWithinBounds) {
  // (p + z^2/2n +- z sqrt(p q/n + z^2/4n^2)) / (1 + z^2/n), symmetric about 1/2
  const Share half = share_of(5, 10);
  WITHIN(half.low, 0.2366, 1e-4, 7e-6);
  WITHIN(half.high, 0.7634, 1e-4, 7e-6);
  EXPECT_EQ(share_of(0, 10).low, 0);
  WITHIN(share_of(0, 10).high, 0.2775, 1e-4, 3.3e-5);
  EXPECT_EQ(share_of(10, 10).high, 1);
  EXPECT_EQ(share_of(0, 0).high, 1);
}

TEST(Shares, AreToldWithTheirInterval) {
  EXPECT_EQ(in_words(share_of(5, 10)), "5 of 10 (50 %, 95 %: 24 to 76 %)");
}

TEST(Shares, WilsonsIntervalCoversTheTruthAsOftenAsItSays) {
  int covered = 0;
  constexpr int experiments = 4000;
  for (int e = 0; e < experiments; ++e) {
    Random random(3, static_cast<std::uint64_t>(e), Stream::other);
    int hits = 0;
    for (int i = 0; i < 60; ++i) hits += random.uniform() < 0.3;
    const Share share = share_of(hits, 60);
    covered += share.low <= 0.3 && 0.3 <= share.high;
  }
  WITHIN(covered / double(experiments), 0.95, 0.02, 0.016);
}

TEST(Shares, UniformValuesHaveUniformPValuesAndOthersHaveNone) {
  int below = 0;
  constexpr int experiments = 2000;
  for (int e = 0; e < experiments; ++e) {
    Random random(4, static_cast<std::uint64_t>(e), Stream::other);
    std::vector<double> values;
    for (int i = 0; i < 60; ++i) values.push_back(random.uniform());
    below += uniformity_p_value(values) < 0.05;
  }
  WITHIN(below / double(experiments), 0.05, 0.02, 4.9e-3);  // standard error
  std::vector<double> squares;
  for (int i = 0; i < 60; ++i) squares.push_back(std::pow((i + 0.5) / 60, 2));
  EXPECT_LT(uniformity_p_value(squares), 0.01);
  // Kolmogorov's table: D = 0.24170 is the 5 % point for n = 30.
  std::vector<double> shifted;
  for (int i = 0; i < 30; ++i) shifted.push_back(std::min(1.0, (i + 1) / 30.0 * (1 - 0.24170)));
  WITHIN(uniformity_p_value(shifted), 0.05, 2e-3, 1.1e-4);
}

TEST(TrialJudgements, AnErrorOfTheCameraIsNamedByTheVerdictMeasurementToo) {
  const auto named = [](const std::vector<std::string>& hidden, const std::vector<std::string>& missing,
                        const std::vector<std::string>& measured) {
    return judge(hidden, true, Verdict::measurement, missing, measured).named;
  };
  EXPECT_TRUE(named({"camera_scale"}, {}, {"camera_scale"}));
  EXPECT_TRUE(named({"camera_scale"}, {}, {"camera_lens", "camera_scale"}));
  EXPECT_FALSE(named({"camera_scale"}, {}, {"camera_lens"}));
  EXPECT_FALSE(named({"camera_scale"}, {"spring_cubic"}, {"camera_scale"}));
  EXPECT_FALSE(named({"grain_friction"}, {}, {"camera_scale"}));
  EXPECT_FALSE(named({}, {}, {"camera_scale"}));
  EXPECT_EQ(effects_standing_out({{"camera_scale.scale", "", 0.01, 0.1, 0.001},
                                  {"camera_lens.distortion", "", 0.01, 0.001, 0.001},
                                  {"box.mass", "kg", 0.002, 0.01, 0.001}}),
            std::vector<std::string>{"camera_scale"});
}

TEST(TrialJudgement, IsThatOfSomebodyWhoKnowsTheAnswer) {
  EXPECT_TRUE(judge({}, false, Verdict::adequate, {}).named);
  EXPECT_TRUE(judge({}, false, Verdict::refit, {}).named);
  EXPECT_FALSE(judge({}, true, Verdict::adequate, {}).named);
  EXPECT_TRUE(judge({"grain_friction"}, true, Verdict::missing, {"grain_friction"}).named);
  EXPECT_TRUE(judge({"camera_scale"}, true, Verdict::missing, {"camera_scale"}).named);
  EXPECT_FALSE(judge({"grain_friction"}, false, Verdict::missing, {"grain_friction", "camera_scale"}).named);
  EXPECT_TRUE(
      judge({"grain_friction"}, false, Verdict::missing, {"grain_friction", "camera_scale"}).invented);
  EXPECT_TRUE(judge({"unknown"}, false, Verdict::unknown, {}).named);
  EXPECT_TRUE(judge({"grain_friction"}, false, Verdict::unknown, {}).detected);
  EXPECT_TRUE(judge({}, false, Verdict::missing, {"spring_cubic"}).invented);
}
