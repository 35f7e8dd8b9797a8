// SPDX-License-Identifier: MIT
// shakedown add and ladder: an effect added by hand, and the error that falls.
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace {

class AddCommand : public WithFolder {};
class LadderCommand : public WithFolder {};
using SlowLadderCommand = LadderCommand;

const std::string commented = "# my damper\n[box]\nlength = \"65 mm\"  # measured twice\n";

}  // namespace

TEST_F(AddCommand, KeepsTheUsersFileAndAddsTheEffectAtItsEnd) {
  const std::string setup = file("setup.toml", commented);
  const Outcome outcome =
      shakedown_program({"add", setup, "grain_friction", "grain_grain=0.2", "--out", in_folder("with.toml")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(contents(in_folder("with.toml")),
            commented + "\n[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.2\n");
  EXPECT_EQ(contents(setup), commented);
}

TEST_F(AddCommand, QuotesQuantitiesAndTakesComponentsTablesAndFormulas) {
  const std::string setup = file("setup.toml", commented);
  const auto added = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"add", setup});
    const Outcome outcome = shakedown_program(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out.substr(std::min(outcome.out.size(), commented.size() + 1));
  };
  EXPECT_EQ(added({"blade_viscous_damping"}),
            "[[effect]]\nname = \"blade_viscous_damping\"\ndamping = \"0.05 N s/m\"\n");
  EXPECT_EQ(added({"constant_acceleration", "acceleration.z=0.2 m/s^2"}),
            "[[effect]]\nname = \"constant_acceleration\"\nacceleration.z = \"0.2 m/s^2\"\n");
  EXPECT_EQ(
      added({"user_force", "force=-c*v*abs(v)", "constants={c = \"0.1 N s^2/m^2\"}"}),
      "[[effect]]\nname = \"user_force\"\nforce = \"-c*v*abs(v)\"\nconstants = {c = \"0.1 N s^2/m^2\"}\n");
}

TEST_F(AddCommand, WritesAnewWhatCannotBeAddedTo) {
  const std::string setup = file("setup.toml", "effect = [{name = \"spring_cubic\", coefficient = 0.04}]\n");
  const Outcome outcome = shakedown_program({"add", setup, "blade_mass", "mass=10g"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("without its comments"), std::string::npos);
  EXPECT_NE(outcome.out.find("spring_cubic"), std::string::npos);
  EXPECT_NE(outcome.out.find("mass = \"0.01 kg\""), std::string::npos) << outcome.out;
}

TEST_F(AddCommand, KeepsPathsWorkingFromAnotherFolder) {
  std::filesystem::create_directories(in_folder("deeper"));
  file("grains.csv", "id,x,y,z,vx,vy,vz\n");
  const std::string setup = file("setup.toml", "[release]\ninitial_grains = \"grains.csv\"\n");
  const Outcome outcome =
      shakedown_program({"add", setup, "grain_friction", "--out", in_folder("deeper/setup.toml")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(contents(in_folder("deeper/setup.toml")).find("initial_grains = \"" + in_folder("grains.csv")),
            std::string::npos);
}

TEST_F(AddCommand, RefusesWhatDoesNotFitWithTheReason) {
  const std::string setup =
      file("setup.toml", commented + "[[effect]]\nname = \"grain_friction\"\ngrain_grain = 0.1\n");
  const auto refused = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"add", setup});
    const Outcome outcome = shakedown_program(words);
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  EXPECT_NE(refused({"grain_friction", "grain_wall=0.2"}).find("is in the setup already"), std::string::npos);
  EXPECT_NE(refused({"blade_viscous_dampign"}).find("did you mean 'blade_viscous_damping'"),
            std::string::npos);
  EXPECT_NE(refused({"blade_viscous_damping", "damping=0.05"}).find("is the bare number"), std::string::npos);
  EXPECT_NE(refused({"blade_viscous_damping", "damping=0 N s/m"}).find("does nothing"), std::string::npos);
  EXPECT_NE(refused({"blade_viscous_damping", "damping"}).find("key=value"), std::string::npos);
}

TEST_F(SlowLadderCommand, ShowsTheErrorFallWhenTheHiddenEffectIsAdded) {
  ASSERT_EQ(shakedown_program({"hide", example("L040.toml"), "--effect",
                               "blade_viscous_damping=damping:0.2 N s/m", "--engine", "hard", "--lengths",
                               "40mm", "--duration", "3 s", "--out", in_folder("case")})
                .code,
            0);
  const std::string setup = in_folder("case/setup.toml"), with = in_folder("case/with.toml");
  ASSERT_EQ(
      shakedown_program({"add", setup, "blade_viscous_damping", "damping=0.2 N s/m", "--out", with}).code, 0);
  const Outcome outcome = shakedown_program(
      {"ladder", setup, with, "--data", in_folder("case/experiment.toml"), "--runs", "24", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json ladder = nlohmann::json::parse(outcome.out)["ladder"];
  ASSERT_EQ(ladder.size(), 2u);
  EXPECT_FALSE(ladder[0]["holds"]);
  EXPECT_TRUE(ladder[1]["holds"]);
  EXPECT_LT(ladder[0]["momentum_p_value"].get<double>(), 1e-6);
  EXPECT_GT(ladder[0]["error_box_mm"].get<double>(), 4 * ladder[1]["error_box_mm"].get<double>());
  EXPECT_LT(ladder[1]["error_box_mm"].get<double>(), 1.6 * ladder[1]["noise_floor"]["box_mm"].get<double>());
  // Nothing that is wrong holds: exit 1.
  EXPECT_EQ(
      shakedown_program({"ladder", setup, "--data", in_folder("case/experiment.toml"), "--runs", "16"}).code,
      1);
}
