// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "within.hpp"

namespace {

class SweepCommand : public WithFolder {
 protected:
  std::vector<std::string> sweep(const std::string& out, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"sweep",  example("L040.toml"),
                                   "--vary", "box.length=40:60:10 mm",
                                   "--runs", "3",
                                   "--set",  "run.duration=2 s",
                                   "--out",  in_folder(out)};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static std::string digest_in(const std::string& text) {
    const std::size_t at = text.rfind("digest ");
    return at == text.npos ? "no digest in: " + text : text.substr(at + 7, 16);
  }
};

TEST_F(SweepCommand, ShardsMergedEqualSerialAndTheTableHoldsThePoints) {
  const Outcome serial = shakedown_program(
      sweep("serial.sqlite", {"--table", in_folder("table.csv"), "--json", in_folder("s.json")}));
  ASSERT_EQ(serial.code, 0) << serial.err;
  EXPECT_NE(serial.err.find("3 points, 9 runs"), std::string::npos) << serial.err;
  const auto document = nlohmann::json::parse(contents(in_folder("s.json")));
  EXPECT_EQ(document["digest"], digest_in(serial.out));
  const std::string finding = document["finding"];
  EXPECT_TRUE(
      finding.starts_with("No point loses 95 % of its energy within the run; least is left at box.length = "))
      << finding;
  EXPECT_TRUE(serial.out.starts_with(finding + "\n")) << serial.out;
  const std::string table = contents(in_folder("table.csv"));
  EXPECT_TRUE(table.starts_with("box_length_mm,runs,failures,slope_mm_per_s,")) << table.substr(0, 100);
  EXPECT_NE(table.find("\n50,3,0,"), std::string::npos);
  EXPECT_EQ(shakedown_program(sweep("one.sqlite", {"--shard", "1/2"})).code, 0);
  EXPECT_EQ(shakedown_program(sweep("two.sqlite", {"--shard", "2/2"})).code, 0);
  const Outcome merged =
      shakedown_program({"merge", in_folder("all.sqlite"), in_folder("one.sqlite"), in_folder("two.sqlite")});
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(digest_in(merged.out), digest_in(serial.out));
}

TEST_F(SweepCommand, ResultsAreNeverOverwrittenUnasked) {
  EXPECT_EQ(shakedown_program(sweep("a.sqlite")).code, 0);
  const Outcome again = shakedown_program(sweep("a.sqlite"));
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("--resume"), std::string::npos) << again.err;
  EXPECT_EQ(shakedown_program(sweep("a.sqlite", {"--resume"})).code, 0);
  EXPECT_EQ(shakedown_program({"merge", in_folder("b.sqlite"), in_folder("none.sqlite")}).code, 4);
}

TEST_F(SweepCommand, AnEstimateLeavesNothingBehind) {
  const Outcome estimate = shakedown_program(sweep("a.sqlite", {"--estimate", "--json"}));
  ASSERT_EQ(estimate.code, 0) << estimate.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  const auto cost = nlohmann::json::parse(estimate.out);
  EXPECT_EQ(cost["runs"], 9);
  EXPECT_EQ(cost["done_before"], 0);
  const double share = 9 * cost["seconds_a_run"].get<double>() / cost["threads"].get<int>();
  WITHIN(cost["seconds"].get<double>() / share, 1, 4e-15, 2.3e-16);
  EXPECT_EQ(shakedown_program(sweep("a.sqlite", {"--estimate", "--table", in_folder("t.csv")})).code, 2);
  ASSERT_EQ(shakedown_program(sweep("a.sqlite", {"--shard", "1/3"})).code, 0);
  const Outcome rest = shakedown_program(sweep("a.sqlite", {"--estimate", "--resume"}));
  EXPECT_NE(rest.out.find("3 of them done before"), std::string::npos) << rest.out;
  EXPECT_EQ(shakedown_program(sweep("a.sqlite", {"--estimate"})).code, 2);  // as the sweep itself would
}

TEST_F(SweepCommand, BadInput) {
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--shard", "3/2"},
                                             {"--vary", "box.lenght=1mm,2mm"},
                                             {"--vary", "box.length=50mm,60mm"},
                                             {"--vary", "grains.count=1,2", "--vary", "box.mass=1,2g"}}) {
    const Outcome outcome = shakedown_program(sweep("a.sqlite", more));
    EXPECT_EQ(outcome.code, 2) << more.back();
    EXPECT_TRUE(outcome.out.empty());
    EXPECT_NE(outcome.err.find(more.front()), std::string::npos) << outcome.err;
  }
}

TEST_F(SweepCommand, UnderMpirun) {
  if (std::system("command -v mpirun >/dev/null 2>&1") != 0) GTEST_SKIP() << "there is no mpirun here";
  const Outcome serial = shakedown_program(sweep("serial.sqlite"));
  std::string command =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 2 '" SHAKEDOWN "'";
  for (const std::string& word : sweep("shared.sqlite")) command += " '" + word + "'";
  ASSERT_EQ(std::system((command + " >'" + in_folder("out") + "' 2>&1").c_str()), 0)
      << contents(in_folder("out"));
  const Outcome whole = shakedown_program(sweep("shared.sqlite", {"--resume"}));
  EXPECT_NE(whole.err.find("nothing is left"), std::string::npos) << whole.err;
  EXPECT_EQ(digest_in(whole.out), digest_in(serial.out));
}

}  // namespace
