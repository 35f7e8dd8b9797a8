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

TEST_F(Interruption, KeepsThePartOfASingleRun) {
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
