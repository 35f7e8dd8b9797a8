// SPDX-License-Identifier: MIT
#include "paper.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engines.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(Chart, DrawsCurvesWithGapsAndWritesTheirNumbers) {
  const Chart chart{"a",
                    "A < B",
                    {{"t, s",
                      "x, mm",
                      {{"one", {0, 1, 2, 3}, {0, std::nan(""), 4, 5}}, {"two", {1, 2}, {3, 3}, false, true}},
                      {{1.5, "here"}}}}};
  const std::string svg = svg_of(chart);
  EXPECT_NE(svg.find("A &lt; B"), std::string::npos);
  EXPECT_NE(svg.find("here"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  const std::string csv = csv_of(chart);
  EXPECT_NE(csv.find("\"x, mm\",\"one\",2,4\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"x, mm\",\"one\",1,\n"), std::string::npos) << csv;
}

TEST(Chart, NothingToDrawIsNoError) {
  EXPECT_EQ(svg_of({"a", "empty", {{"x", "y", {}}, {"x", "y", {{"flat", {1, 1}, {2, 2}}}}}}).find("nan"),
            std::string::npos);
}

TEST(Statement, IntervalsAreStudents) {
  const Finding finding = finding_of("a", {10, 2, 4}, "s");
  WITHIN(finding.high - finding.value, 3.182 * 2 / 2, 1e-3, 4.5e-4);
  WITHIN(finding_of("a", {10, 2, 31}, "s").high, 10 + 2.0423 * 2 / std::sqrt(31), 1e-4, 9.9e-6);
  EXPECT_TRUE(std::isnan(finding_of("a", {10, std::nan(""), 1}, "s").low));
}

TEST(Statement, Judgement) {
  EXPECT_EQ(judge({"a", 1, 0.9, 1.1, ""}, 0.8, 1.2), Judgement::holds);
  EXPECT_EQ(judge({"a", 1, 0.9, 1.1, ""}, 1.05, 1.2), Judgement::cannot_tell);
  EXPECT_EQ(judge({"a", 1, 0.9, 1.1, ""}, 1.2, 1.3), Judgement::fails);
  EXPECT_EQ(judge({"a", std::nan(""), 0, 0, ""}, 0, 1), Judgement::cannot_tell);
  EXPECT_EQ(all_of({Judgement::holds, Judgement::cannot_tell}), Judgement::cannot_tell);
  EXPECT_EQ(all_of({Judgement::fails, Judgement::cannot_tell}), Judgement::fails);
  EXPECT_EQ(all_of({}), Judgement::cannot_tell);
}

TEST(DamperRuns, ReadingsOfTheDamperThatThePaperFitted) {
  shakedown::Setup setup;
  setup.run.duration = 16;
  const DamperRuns runs = damper_runs(*engine_named("hard"), setup, {4, 2});
  // k (Delta0 - |x_3|) / 6 with |x_3| = 96.1 mm.
  WITHIN(runs.over(&RunReading::friction).mean, 25.92 * (0.1075 - 0.0961) / 6, 4e-4, 2.4e-5);
  EXPECT_GT(runs.over(&RunReading::energy_line_r2).mean, 0.99);
  EXPECT_GT(runs.over(&RunReading::friction_curve_r2).mean, 0.8);
  EXPECT_GT(runs.rms_of_one_run_box, 0);
  EXPECT_LT(runs.rms_of_one_run_box, 1e-3);
  EXPECT_TRUE(std::isnan(runs.over(&RunReading::swing_after_20s).mean));
}

TEST(LengthSweep, TheShortestBoxLosesItsEnergyLast) {
  const LengthSweep sweep =
      sweep_lengths(*engine_named("hard"), shakedown::Setup{}, {0.025, 0.085, 0.300}, {2, 2});
  EXPECT_EQ(sweep.fastest(), 2u);
  EXPECT_EQ(sweep.points[0].censored[3] + sweep.points[0].seconds[3].n, 2);
  WITHIN(sweep.points[1].seconds[3].mean, 3.93, 0.1, 7.3e-3);  // 3.93 +- 0.02 s of a reference code
}
