// SPDX-License-Identifier: MIT
// Each mistake: one clear message on standard error, nothing on standard output, the right exit code.
#include "program.hpp"

namespace fs = std::filesystem;

class BadInput : public WithFolder {
 protected:
  /// Expects exit code 2 and the given words in the message, in one line unless more are announced.
  void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words,
                      int lines = 1) const {
    const Outcome outcome = shakedown_program(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), lines) << outcome.err;
  }
  void expect_setting_refused(const std::string& setting, const std::vector<std::string>& words) const {
    expect_refused({"run", example("L040.toml"), "--set", setting}, words);
  }
};

TEST_F(BadInput, UnknownKey) {
  expect_refused({"run", file("a.toml", "[box]\nlenght = \"40 mm\"\n")},
                 {"a.toml:2:1", "lenght", "did you mean", "length"});
}
TEST_F(BadInput, WrongUnit) { expect_setting_refused("box.length=40 g", {"box.length"}); }
TEST_F(BadInput, BareNumber) {
  expect_refused({"run", file("a.toml", "[box]\nmass = 434\n")}, {"a.toml:2:", "box.mass", "unit"});
}
TEST_F(BadInput, NegativeMass) { expect_setting_refused("box.mass=-434 g", {"box.mass"}); }
TEST_F(BadInput, MoreGrainsThanFit) { expect_setting_refused("grains.count=5000", {"grains.count"}); }
TEST_F(BadInput, BoxShorterThanAGrain) { expect_setting_refused("box.length=5 mm", {"box.length"}); }
TEST_F(BadInput, ZeroDuration) { expect_setting_refused("run.duration=0 s", {"run.duration"}); }
TEST_F(BadInput, NotANumber) { expect_setting_refused("box.mass=nan g", {"box.mass"}); }
TEST_F(BadInput, NotToml) { expect_refused({"run", file("a.toml", "[box\nmass = 3\n")}, {"a.toml:1"}); }
TEST_F(BadInput, SettingWithoutAValue) { expect_setting_refused("box.mass", {"box.mass", "key=value"}); }

TEST_F(BadInput, EveryMistakeAtOnce) {
  expect_refused({"run", file("a.toml", "[box]\nmass = 434\nlength = \"4 g\"\n[grains]\ncuont = 3\n")},
                 {"a.toml:2:", "a.toml:3:", "a.toml:5:"}, 3);
}

TEST_F(BadInput, OverlappingGrains) {
  const std::string grains = file("g.csv", "id,x,y,z,vx,vy,vz\n1,0.1075,0,0,0,0,0\n2,0.1125,0,0,0,0,0\n");
  expect_refused(
      {"run", example("L040.toml"), "--set", "grains.count=2", "--set", "release.initial_grains=" + grains},
      {"g.csv:3", "overlap"});
}

TEST_F(BadInput, UnknownEngine) {
  expect_refused({"run", example("L040.toml"), "--engine", "magic"}, {"magic", "hard"});
}

TEST_F(BadInput, Usage) {
  expect_refused({}, {"--help"}, 2);
  expect_refused({"run"}, {"SETUP"}, 2);
  expect_refused({"run", example("L040.toml"), "--runs", "0"}, {"--runs"}, 2);
  expect_refused({"compare", example("L040.toml"), "--runs", "15"}, {"--runs", "16"}, 2);
  for (const char* command : {"run", "compare", "diagnose", "ladder", "fit", "sweep", "paper"})
    expect_refused({command, "--threads", "-1"}, {"--threads", "1024"}, 2);
  expect_refused({"run", example("L040.toml"), "--no-such-option"}, {"--no-such-option"}, 2);
  expect_refused({"jump"}, {"jump"}, 2);
}

TEST_F(BadInput, ScoringWhereNoSuiteIsMakesNoFolder) {
  expect_refused({"blind-suite", "--score", "--out", in_folder("typo")}, {"typo", "--score", "plan.json"});
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(BadInput, MissingFileIsExitFour) {
  for (const char* command : {"run", "theory"}) {
    const Outcome outcome = shakedown_program({command, in_folder("none.toml")});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("none.toml"), std::string::npos);
  }
}

TEST_F(BadInput, UnwritableOutputIsExitFourBeforeAnyWork) {
  file("plain", "");
  const std::string forever = "run.duration=1e7 s";
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{"--out", in_folder("plain/out")},
                                             {"--out", in_folder("plain")},
                                             {"--json", in_folder("plain/a.json")},
                                             {"--json", folder.path().string()}}) {
    std::vector<std::string> arguments{"run", example("L040.toml"), "--set", forever, "--rate", "1"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    const Outcome outcome = shakedown_program(arguments);
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("cannot be written"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
}

TEST_F(BadInput, EmptySetup) {
  expect_refused({"run", file("a.toml", "")}, {"a.toml", "holds no key"});
  expect_refused({"run", file("a.toml", "# my damper\n"), "--set", "box.length=50mm"}, {"holds no key"});
}

TEST_F(BadInput, StrictRefusesThePapersValues) {
  const std::string setup = file("a.toml", "[box]\nlength = \"50 mm\"\n[grains]\ncount = 0\n");
  expect_refused({"run", setup, "--strict"},
                 {"box.mass", "spring.frequency", "release.displacement", "434 g"}, 3);
  const Outcome outcome =
      shakedown_program({"run", setup, "--set", "run.duration=1 s", "--json", in_folder("a.json")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("taken from the paper: box.mass = 434 g, spring.frequency"), std::string::npos)
      << outcome.out;
  EXPECT_NE(contents(folder / "a.json").find("\"release.displacement = 107.5 mm\""), std::string::npos);
}

TEST_F(BadInput, NumbersOfOptionsAreNumbers) {
  const std::string setup = example("L040.toml");
  expect_refused({"hide", setup, "--seed", "-1", "--out", in_folder("x")}, {"--seed", "-1"}, 2);
  expect_refused({"hide", setup, "--seed", "18446744073709551616", "--out", in_folder("x")}, {"--seed"}, 2);
  expect_refused({"crosscheck", setup, "--slope-margin", "nan"}, {"--slope-margin", "nan"}, 2);
  expect_refused({"diagnose", setup, "--data", setup, "--seconds", "nan"}, {"--seconds", "nan"}, 2);
}

TEST_F(BadInput, WordsThatNameNoFile) {
  const std::string setup = example("L040.toml");
  expect_refused({"run", setup, "--out", in_folder("\xff")}, {"\\xff", "UTF-8"});
  expect_refused({"run", setup, "--out", ""}, {"--out", "empty"});
  expect_refused({"run", setup, "--report="}, {"--report", "empty"});
  EXPECT_TRUE(fs::is_empty(folder));
}

/// What the file system refuses is the user's to mend, not a bug.
TEST_F(BadInput, PathsThatLeadNowhere) {
  const std::string long_name = in_folder(std::string(300, 'a'));
  fs::create_symlink("loop", folder / "loop");
  for (const std::string& path : {long_name, in_folder("loop"), in_folder("loop/a.toml")}) {
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"run", path},
             {"import", path},
             {"report", path, "--out", in_folder("r.html")},
             {"export", path},
             {"compare", example("L040.toml"), "--data", path},
             {"merge", in_folder("m.sqlite"), path},
             {"merge", path, path},
             {"import", example("L040.toml"), "--out", path},
             {"diagnose", example("L040.toml"), "--data", example("L040.toml"), "--out", path},
             {"sweep", example("L040.toml"), "--vary", "box.length=40mm,50mm", "--estimate", "--out",
              path}}) {
      const Outcome outcome = shakedown_program(arguments);
      EXPECT_TRUE(outcome.code == 4 || outcome.code == 2)
          << arguments[0] << " " << path << ": " << outcome.err;
    }
  }
}

TEST_F(BadInput, ControlCharactersDoNotReachTheTerminal) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"x\033[31m"}, {"run", "a\033[31m"}, {"run", "a", "--b\033[31m"}}) {
    const Outcome outcome = shakedown_program(arguments);
    EXPECT_EQ(outcome.err.find('\033'), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("\\x1b[31m"), std::string::npos) << outcome.err;
  }
}
