// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {
class HideCommand : public WithFolder {};
}  // namespace

TEST_F(HideCommand, WritesMeasurementsTheUsersSetupAndTheAnswerApart) {
  const Outcome outcome = shakedown_program({"hide", example("L040.toml"), "--effect", "blade_viscous_damping", "--engine", "hard", "--lengths",
                                             "40mm,65mm", "--duration", "1 s", "--camera", "fps=100", "--out", in_folder("case"), "--truth",
                                             in_folder("answers/case.json")});
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
  const Outcome outcome = shakedown_program({"hide", example("L040.toml"), "--effect", "grain_frictoin", "--out", in_folder("case")});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("did you mean 'grain_friction'"), std::string::npos) << outcome.err;
}
