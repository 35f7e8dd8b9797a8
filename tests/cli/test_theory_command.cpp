// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "program.hpp"
#include "within.hpp"

using nlohmann::json;

class TheoryCommand : public WithFolder {};

TEST_F(TheoryCommand, GivesThePapersNumbers) {
  const Outcome outcome = shakedown_program({"theory", example("L040.toml"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json theory = json::parse(outcome.out);
  WITHIN(theory["spring"]["beam_stiffness_N_per_m"], 25.4, 0.05, 0.011);
  WITHIN(theory["spring"]["stiffness_N_per_m"], 25.92, 0.005, 1.5e-3);
  WITHIN(theory["loaded_frequency_hz"], 1.0608, 1e-4, 8.5e-6);
  WITHIN(theory["optimal_length_m"], 0.3113, 1e-4, 3.4e-5);
  // The third peak is 96.1 mm: k (107.5 - 96.1) mm / 6.
  WITHIN(theory["friction"]["effective_friction_N"], 25.92 * (0.1075 - 0.0961) / 6, 0.004, 1.2e-3);
}

TEST_F(TheoryCommand, TheCurveGoesThroughTheRunsThirdPeak) {
  const Outcome outcome = shakedown_program(
      {"theory", example("L085.toml"), "--out", in_folder("curve.csv"), "--json", in_folder("a.json")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(contents(folder / "curve.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "t_s,x_box_m,v_box_m_per_s");
  double lowest = 0;  // between 1.0 and 1.9 s lies the third extremum
  while (std::getline(lines, line)) {
    double t = 0, x = 0;
    char comma = 0;
    std::istringstream(line) >> t >> comma >> x;
    if (t > 1.0 && t < 1.9) lowest = std::min(lowest, x);
  }
  const json theory = json::parse(contents(folder / "a.json"));
  WITHIN(1e3 * lowest, theory["friction"]["third_peak_mm"], 8e-6, 4.4e-7);
}

TEST_F(TheoryCommand, WithoutThreePeaksThereIsNoFriction) {
  const Outcome outcome =
      shakedown_program({"theory", example("L040.toml"), "--set", "run.duration=0.4 s", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(json::parse(outcome.out)["friction"].is_null());
  EXPECT_EQ(shakedown_program(
                {"theory", example("L040.toml"), "--set", "run.duration=0.4 s", "--out", in_folder("c.csv")})
                .code,
            2);
}

TEST_F(TheoryCommand, RefusesWhatHasNoSpring) {
  const Outcome outcome = shakedown_program(
      {"theory", example("L040.toml"), "--set", "domain.kind=closed", "--set", "grains.count=0"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("domain.kind"), std::string::npos) << outcome.err;
}
