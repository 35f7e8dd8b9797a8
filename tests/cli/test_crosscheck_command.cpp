// SPDX-License-Identifier: MIT
#include <filesystem>
#include <nlohmann/json.hpp>

#include "program.hpp"

using nlohmann::json;

namespace {

class CrosscheckCommand : public WithFolder {
 protected:
  /// Two short runs of the hard and the soft engine, with coarse contacts.
  Outcome short_crosscheck(std::vector<std::string> more, const char* runs = "2") const {
    std::vector<std::string> arguments{"crosscheck", example("L040.toml"),     "--set",  "run.duration=2.5 s",
                                       "--set",      "soft.contact_time=3 ms", "--runs", runs};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return shakedown_program(arguments);
  }
};

class CheckCommand : public WithFolder {};

}  // namespace

TEST_F(CrosscheckCommand, WithinWideMarginsItSucceedsAndWritesItsFiles) {
  const Outcome outcome =
      short_crosscheck({"--slope-margin", "100", "--share-margin", "1", "--out", in_folder("out"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json one = json::parse(outcome.out)["crosschecks"][0];
  EXPECT_EQ(one["engines"][0]["engine"], "hard");
  EXPECT_EQ(one["engines"][1]["slope_mm_per_s"]["n"], 2);
  for (const json& comparison : one["comparisons"])
    EXPECT_EQ(comparison["verdict"], "equivalent") << comparison;
  for (const char* name : {"numbers.csv", "verdicts.csv", "summary.json"})
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / name)) << name;
}

TEST_F(CrosscheckCommand, BeyondItsMarginADifferenceIsExitOne) {
  // Two runs do not always tell the engines apart; with six the shares of energy differ by ten standard
  // errors.
  const Outcome outcome = short_crosscheck({"--engines", "hard,hard,soft", "--share-margin", "1e-12"}, "6");
  EXPECT_EQ(outcome.code, 1) << outcome.out;
  EXPECT_NE(outcome.out.find("standard errors"), std::string::npos) << outcome.out;
}

TEST_F(CrosscheckCommand, VariesAKey) {
  const Outcome outcome =
      shakedown_program({"crosscheck", example("L040.toml"), "--vary", "box.length=40mm,65mm", "--set",
                         "run.duration=1.5 s", "--engines", "hard", "--runs", "1", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json found = json::parse(outcome.out)["crosschecks"];
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1]["setup"], "L040.toml box.length=65mm");
}

TEST_F(CrosscheckCommand, RefusesWhatItCannotUse) {
  EXPECT_EQ(short_crosscheck({"--engines", "hard,fluid"}).code, 2);
  EXPECT_EQ(short_crosscheck({"--vary", "box.length"}).code, 2);
}

TEST_F(CheckCommand, FailsWithoutABaselineAndPassesAfterAnUpdate) {
  const std::vector<std::string> arguments{
      "check", "linear-decay", "--engines", "hard",        "--lengths",
      "40",    "--runs",       "8",         "--baselines", in_folder("b.json")};
  EXPECT_EQ(shakedown_program(arguments).code, 4);
  std::vector<std::string> update = arguments;
  update.emplace_back("--update");
  ASSERT_EQ(shakedown_program(update).code, 0);
  std::vector<std::string> with_json = arguments;
  with_json.emplace_back("--json");
  const Outcome outcome = shakedown_program(with_json);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const json checked = json::parse(outcome.out);
  EXPECT_TRUE(checked["passed"]);
  EXPECT_EQ(checked["checks"].size(), 3u);

  // A stored slope of another physics.
  json baselines = json::parse(contents(folder / "b.json"));
  baselines["baselines"][0]["slope_mm_per_s"]["high"] = -100;
  file("b.json", baselines.dump());
  EXPECT_EQ(shakedown_program(arguments).code, 1);
}
