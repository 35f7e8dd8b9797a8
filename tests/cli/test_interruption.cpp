// SPDX-License-Identifier: MIT
// Ctrl-C keeps what is done and exits 130.
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;

class Interruption : public WithFolder {
 protected:
  void SetUp() override {
    WithFolder::SetUp();
    if (!has_terminals()) GTEST_SKIP() << "no pseudo terminals here";
  }
};
using SlowInterruption = Interruption;

TEST_F(SlowInterruption, KeepsThePartOfASingleRun) {
  const Outcome outcome = interrupted_program(
      {"run", example("L040.toml"), "--set", "run.duration=1e7 s", "--rate", "1", "--out", in_folder("out")},
      " %");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  const json summary = json::parse(contents(folder / "out/summary.json"));
  EXPECT_TRUE(summary["interrupted"]);
  EXPECT_GT(summary["end_time_s"], 1);
  EXPECT_LT(summary["end_time_s"], 1e7);
  EXPECT_FALSE(contents(folder / "out/series.csv").empty());
  EXPECT_NE(outcome.out.find("interrupted at"), std::string::npos) << outcome.out;
}

TEST_F(Interruption, KeepsFinishedRunsOfAnEnsemble) {
  // The time left is shown from 2 % on: then two thousand runs are done, however slowly the machine got there
  // (a bar alone can be shown by a first run that a busy machine held up).
  const Outcome outcome =
      interrupted_program({"run", example("L040.toml"), "--set", "run.duration=0.01 s", "--runs", "100000",
                           "--threads", "2", "--out", in_folder("out")},
                          " s left");
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  const json summary = json::parse(contents(folder / "out/summary.json"));
  EXPECT_TRUE(summary["interrupted"]);
  EXPECT_GE(summary["runs"]["finished"], 1000);
  EXPECT_LT(summary["runs"]["finished"], 100000);
  EXPECT_EQ(summary["initial_energy_J"]["n"], summary["runs"]["finished"]);
}

TEST_F(SlowInterruption, DiagnosisGoesOnWithWhatItHasSimulated) {
  // Other restitutions: the model as given fails, and parameters are fitted.
  ASSERT_EQ(shakedown_program({"hide", example("L040.toml"), "--engine", "hard", "--lengths", "40mm,65mm",
                               "--duration", "2 s", "--set", "restitution.grain_wall=0.9", "--out",
                               in_folder("case")})
                .code,
            0);
  const std::vector<std::string> diagnosis{
      "diagnose",  example("L040.toml"), "--data", in_folder("case/experiment.toml"),
      "--effects", "spring_cubic",       "--json", "-"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> words = diagnosis;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const Outcome whole = shakedown_program(diagnosis);
  EXPECT_EQ(whole.code, 1) << whole.err;
  const Outcome cut = interrupted_program(with({"--out", in_folder("out")}), "the model as given");
  EXPECT_EQ(cut.code, 130) << cut.err;
  EXPECT_NE(cut.err.find("--resume goes on"), std::string::npos) << cut.err;
  const auto journal = folder / "out/simulations.journal";
  EXPECT_GT(std::filesystem::file_size(journal), 1000u);
  const Outcome resumed = shakedown_program(with({"--out", in_folder("out"), "--resume"}));
  EXPECT_EQ(resumed.code, 1) << resumed.err;
  EXPECT_FALSE(std::filesystem::exists(journal));
  json a = json::parse(whole.out), b = json::parse(resumed.out);
  a.erase("seconds"), b.erase("seconds");
  EXPECT_EQ(a, b);
}
