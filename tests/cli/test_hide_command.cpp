// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {
class HideCommand : public WithFolder {};
}  // namespace

TEST_F(HideCommand, WritesMeasurementsTheUsersSetupAndTheAnswerApart) {
  const Outcome outcome =
      shakedown_program({"hide", example("L040.toml"), "--effect", "blade_viscous_damping", "--engine",
                         "hard", "--lengths", "40mm,65mm", "--duration", "1 s", "--camera", "fps=100",
                         "--out", in_folder("case"), "--truth", in_folder("answers/case.json")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("blade_viscous"), std::string::npos);
  EXPECT_EQ(contents(in_folder("case/setup.toml")).find("blade_viscous"), std::string::npos);
  EXPECT_EQ(contents(in_folder("case/L040.csv")).substr(0, 20), "t_s,x_box_m,x_com_m\n");
  EXPECT_TRUE(std::filesystem::exists(in_folder("case/experiment.toml")));
  const nlohmann::json answer = nlohmann::json::parse(contents(in_folder("answers/case.json")));
  EXPECT_EQ(answer["hidden"][0], "blade_viscous_damping");
  EXPECT_FALSE(std::filesystem::exists(in_folder("case/truth.json")));
}

TEST_F(HideCommand, SaysWhatIsWrongWithItsArguments) {
  const Outcome outcome = shakedown_program(
      {"hide", example("L040.toml"), "--effect", "grain_frictoin", "--camera", "fsp=500", "--lengths", "40"});
  EXPECT_EQ(outcome.code, 2);
  for (const char* each : {"--camera: fsp", "--lengths", "--out"})
    EXPECT_NE(outcome.err.find(each), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("did you mean 'grain_friction'"), std::string::npos) << outcome.err;
}

TEST_F(HideCommand, RefusesAnEffectThatDoesNothingAlone) {
  const Outcome outcome =
      shakedown_program({"hide", example("L040.toml"), "--effect", "grain_rolling_resistance", "--lengths",
                         "40mm", "--duration", "1 s", "--out", in_folder("case")});
  EXPECT_EQ(outcome.code, 2) << outcome.out;
  EXPECT_NE(
      outcome.err.find("grain_rolling_resistance: does nothing without grain_friction; hide both: --effect "
                       "grain_friction --effect grain_rolling_resistance"),
      std::string::npos)
      << outcome.err;
}

TEST_F(HideCommand, PowerCountsAnswersAndWritesNothing) {
  // The least budget and a model that holds: one comparison, about a second.
  const Outcome outcome =
      shakedown_program({"hide", example("L040.toml"), "--engine", "hard", "--lengths", "40mm", "--duration",
                         "2 s", "--power", "--repeats", "1", "--budget", "256", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json power = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(power["detected"]["trials"], 1);
  EXPECT_EQ(power["named"]["hits"], 1);
  EXPECT_EQ(power["detected"]["low"], 0.0);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(HideCommand, LeavesNothingOfItsEarlierCaseAndTouchesNobodyElses) {
  const auto hide = [&](const std::string& lengths) {
    return shakedown_program({"hide", example("L040.toml"), "--engine", "hard", "--lengths", lengths,
                              "--duration", "0.2 s", "--out", in_folder("case")});
  };
  ASSERT_EQ(hide("40mm,65mm").code, 0);
  file("case/mine.csv", "t,x\n");
  ASSERT_EQ(hide("85mm").code, 0);
  EXPECT_FALSE(std::filesystem::exists(in_folder("case/L040.csv")));
  EXPECT_TRUE(std::filesystem::exists(in_folder("case/L085.csv")));
  EXPECT_TRUE(std::filesystem::exists(in_folder("case/mine.csv")));
  file("case/setup.toml", "[box]\nlength = \"40 mm\"\n");
  const Outcome refused = hide("40mm");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("is an experiment that this command did not make"), std::string::npos)
      << refused.err;
}
