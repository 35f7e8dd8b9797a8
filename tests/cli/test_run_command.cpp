// SPDX-License-Identifier: MIT
#include <fstream>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "within.hpp"

using nlohmann::json;
namespace fs = std::filesystem;

class RunCommand : public WithFolder {};

TEST_F(RunCommand, WritesSeriesSummarySetupAndProvenance) {
  const Outcome outcome = shakedown_program(
      {"run", example("L040.toml"), "--set", "run.duration=6 s", "--rate", "200", "--out", in_folder("out")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("mm/s"), std::string::npos);
  const std::string series = contents(folder / "out/series.csv");
  EXPECT_EQ(
      series.substr(0, series.find('\n')),
      "t_s,x_box_m,v_box_m_per_s,x_com_m,total_energy_J,loss_grain_grain_J,loss_end_wall_J,loss_side_wall_J");
  EXPECT_EQ(std::count(series.begin(), series.end(), '\n'), 1 + 1201);
  const json summary = json::parse(contents(folder / "out/summary.json"));
  WITHIN(summary["frequency_hz"], 1.0478, 0.002, 2e-4);  // 1.0478 (.0001) of many runs
  WITHIN(summary["slope_mm_per_s"], -8.20, 0.3, 0.035);  // -8.20 (.05) of the full fit to 8 s
  WITHIN(summary["peaks_mm"][7], 76.4, 1.0, 0.62);
  EXPECT_LT(summary["ledger_error"], 1e-12);
  const json provenance = json::parse(contents(folder / "out/provenance.json"));
  EXPECT_EQ(provenance["seed"], 1);
  EXPECT_FALSE(provenance["program"]["compiler"].get<std::string>().empty());
}

TEST_F(RunCommand, ItsFolderCanBeRunAgain) {
  const std::string grains = std::string(TEST_DATA) + "/init_damper_L40.csv";
  const Outcome first =
      shakedown_program({"run", example("L040.toml"), "--set", "release.initial_grains=" + grains, "--set",
                         "run.duration=0.5 s", "--seed", "5", "--out", in_folder("first")});
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_TRUE(fs::exists(folder / "first/initial_grains.csv"));
  const Outcome again =
      shakedown_program({"run", in_folder("first/setup.toml"), "--out", in_folder("again")});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(contents(folder / "first/series.csv"), contents(folder / "again/series.csv"));
  EXPECT_EQ(contents(folder / "first/setup.toml"), contents(folder / "again/setup.toml"));
}

TEST_F(RunCommand, KeepsWhatAnotherProgramWasGivenAndAnswered) {
  const fs::path program = folder / "at_rest";
  std::ofstream(program) << "#!/bin/sh\nprintf 't_s,x_box_m,v_box_m_s\\n0,0.1075,0\\n' > $2\n";
  fs::permissions(program, fs::perms::owner_all);
  const Outcome outcome =
      shakedown_program({"run", example("L040.toml"), "--engine", "command:" + program.string(), "--set",
                         "grains.count=0", "--set", "run.duration=1 ms", "--keep", in_folder("kept")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(json::parse(contents(folder / "kept/at_rest/run_0/setup.json"))["rows"], 1);
  EXPECT_TRUE(fs::exists(folder / "kept/at_rest/run_0/motion.csv"));
}

TEST_F(RunCommand, EnsemblesAreTheSameForAnyNumberOfThreads) {
  for (const std::string threads : {"1", "2"}) {
    const Outcome outcome =
        shakedown_program({"run", example("L040.toml"), "--set", "run.duration=1 s", "--runs", "6",
                           "--threads", threads, "--out", in_folder(threads), "--every-series"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  for (const char* name : {"series.csv", "mean_series.csv", "runs.csv", "setup.toml", "series/run_0005.csv"})
    EXPECT_EQ(contents(folder / "1" / name), contents(folder / "2" / name)) << name;
  json one = json::parse(contents(folder / "1/summary.json")),
       two = json::parse(contents(folder / "2/summary.json"));
  for (json* summary : {&one, &two})
    for (const char* key : {"wall_seconds", "collisions_per_second"}) summary->erase(key);
  EXPECT_EQ(one, two);
  EXPECT_EQ(one["peaks_mm"][0]["n"], 6);
}

TEST_F(RunCommand, TheSeedDecides) {
  const auto series = [&](const std::string& seed) {
    const std::string out = in_folder("seed" + seed);
    EXPECT_EQ(shakedown_program(
                  {"run", example("L040.toml"), "--set", "run.duration=0.3 s", "--seed", seed, "--out", out})
                  .code,
              0);
    return contents(fs::path(out) / "series.csv");
  };
  EXPECT_NE(series("1"), series("2"));
}

TEST_F(RunCommand, JsonGoesToStandardOutputAndTheRestAside) {
  const std::vector<std::vector<std::string>> ways{
      {"run", example("L040.toml"), "--set", "run.duration=0.2 s", "--json"},
      {"run", example("L040.toml"), "--set", "run.duration=0.2 s", "--json", "-"},
      {"run", "--json", example("L040.toml"), "--set", "run.duration=0.2 s"}};
  for (const std::vector<std::string>& arguments : ways) {
    const Outcome outcome = shakedown_program(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out)["engine"], "hard");
    EXPECT_NE(outcome.err.find("deepest overlap"), std::string::npos);
  }
}

TEST_F(RunCommand, JsonGoesToAFile) {
  const Outcome outcome = shakedown_program(
      {"run", example("L040.toml"), "--set", "run.duration=0.2 s", "--json", in_folder("a.json")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(json::parse(contents(folder / "a.json"))["schema_version"], 1);
  EXPECT_NE(outcome.out.find("deepest overlap"), std::string::npos);
}

TEST_F(RunCommand, WithoutATerminalThereIsOnePlainLine) {
  const Outcome outcome = shakedown_program({"run", example("L040.toml"), "--set", "run.duration=0.2 s"});
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos);
}

TEST_F(RunCommand, AnEmptyBoxSwingsAtItsOwnFrequency) {
  const Outcome outcome = shakedown_program(
      {"run", example("L040.toml"), "--set", "grains.count=0", "--set", "run.duration=8 s", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json summary = json::parse(outcome.out);
  WITHIN(summary["frequency_hz"], 1.23, 9e-14, 4.5e-15);
  for (const json& peak : summary["peaks_mm"]) WITHIN(std::abs(peak.get<double>()), 107.5, 3e-7, 1.6e-8);
}

TEST(Help, IsGivenAndSucceeds) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"--help"}, {"run", "--help"}, {"theory", "--help"}, {"--version"}}) {
    const Outcome outcome = shakedown_program(arguments);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_FALSE(outcome.out.empty());
  }
}
