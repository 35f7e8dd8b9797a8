// SPDX-License-Identifier: MIT
// No option makes a command replace what it reads, a link or a pipe, nor call a full disk a success.
#include <sys/stat.h>
#include <sys/wait.h>

#include <cstdlib>

#include "output_file.hpp"
#include "program.hpp"

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> briefly{"--set", "run.duration=0.1 s"};

class Outputs : public WithFolder {
 protected:
  /// Exit code 4, one line that names the file, and the file as it was.
  void expect_kept(std::vector<std::string> arguments, const std::string& option,
                   const std::string& name) const {
    const std::string before = contents(folder / name);
    arguments.insert(arguments.end(), {option, in_folder(name)});
    const Outcome outcome = shakedown_program(arguments);
    SCOPED_TRACE(arguments[0] + " " + option + " " + name);
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find(name + ": cannot be written ("), std::string::npos) << outcome.err;
    EXPECT_EQ(contents(folder / name), before);
  }
  /// The exit code of a command line of the shell.
  static int code_of(const std::string& line) {
    const int status = std::system((std::string(SHAKEDOWN) + " " + line).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string setup() const { return file("mine.toml", contents(example("L040.toml"))); }
};

std::vector<std::string> joined(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_F(Outputs, ReplaceNoSetup) {
  const std::string mine = setup();
  expect_kept(joined({"run", mine}, briefly), "--report", "mine.toml");
  expect_kept(joined({"theory", mine}, briefly), "--out", "mine.toml");
  expect_kept({"sweep", mine, "--vary", "box.length=40mm,50mm", "--set", "run.duration=0.1s", "--out",
               in_folder("r.sqlite")},
              "--table", "mine.toml");
  expect_kept({"hide", mine, "--lengths", "40mm", "--duration", "0.1 s", "--out", in_folder("case")},
              "--truth", "mine.toml");
  fs::create_directory(folder / "used");
  fs::copy_file(mine, folder / "used" / "setup.toml");
  for (const char* command : {"run", "hide"}) {
    const std::string before = contents(folder / "used" / "setup.toml");
    const Outcome outcome =
        shakedown_program({command, in_folder("used/setup.toml"), "--out", in_folder("used")});
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_EQ(contents(folder / "used" / "setup.toml"), before) << command;
  }
}

TEST_F(Outputs, ReplaceNoFilmAndNoResultsThatTheyShow) {
  ASSERT_EQ(shakedown_program({"hide", setup(), "--engine", "hard", "--lengths", "40mm", "--duration", "2 s",
                               "--camera", "fps=100", "--out", in_folder("")})
                .code,
            0);
  const std::vector<std::string> compare{
      "compare", in_folder("setup.toml"), "--data", in_folder("experiment.toml"), "--runs", "16"};
  expect_kept(compare, "--json", "L040.csv");
  expect_kept(compare, "--report", "experiment.toml");
  expect_kept({"import", in_folder("L040.csv"), "--replace"}, "--out", "L040.csv");
  ASSERT_EQ(shakedown_program(joined({"run", setup(), "--out", in_folder("k")}, briefly)).code, 0);
  expect_kept({"report", in_folder("k")}, "--out", "k/report.json");
  const std::string results = in_folder("r.sqlite");
  ASSERT_EQ(shakedown_program({"sweep", setup(), "--vary", "box.length=40mm,50mm", "--set",
                               "run.duration=0.1s", "--out", results})
                .code,
            0);
  expect_kept({"merge", in_folder("all.sqlite"), results}, "--table", "r.sqlite");
  expect_kept({"report", results}, "--out", "r.sqlite");
}

TEST_F(Outputs, LeaveLinksAndPipesAlone) {
  file("precious", "mine");
  fs::create_symlink("precious", folder / "link");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const char* name : {"link", "pipe"}) {
    for (const char* option : {"--json", "--report"}) {
      const Outcome outcome = shakedown_program(joined({"run", setup(), option, in_folder(name)}, briefly));
      EXPECT_EQ(outcome.code, 4) << outcome.err;
      EXPECT_NE(outcome.err.find("results would take its place"), std::string::npos) << outcome.err;
    }
  }
  fs::create_directory(folder / "case");
  fs::create_symlink("../precious", folder / "case" / "L040.csv");
  EXPECT_EQ(shakedown_program({"hide", setup(), "--engine", "hard", "--lengths", "40mm", "--duration",
                               "0.2 s", "--out", in_folder("case")})
                .code,
            4);
  EXPECT_EQ(contents(folder / "precious"), "mine");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST_F(Outputs, OfTwoProgramsDoNotMix) {
  const shakedown::OutputFolder first(folder / "k", shakedown::OutputFolder::Use::alone);
  const Outcome second = shakedown_program(joined({"run", setup(), "--out", in_folder("k")}, briefly));
  EXPECT_EQ(second.code, 4);
  EXPECT_NE(second.err.find("another program is writing its results there"), std::string::npos) << second.err;
}

TEST_F(Outputs, OfASecondRunAreItsOwn) {
  const std::string out = in_folder("k");
  ASSERT_EQ(shakedown_program(joined({"run", setup(), "--out", out, "--log"}, briefly)).code, 0);
  EXPECT_TRUE(fs::exists(folder / "k" / "collisions.log"));
  ASSERT_EQ(
      shakedown_program(joined({"run", setup(), "--out", out, "--set", "box.length=65mm"}, briefly)).code, 0);
  EXPECT_FALSE(fs::exists(folder / "k" / "collisions.log"));
  EXPECT_EQ(shakedown_program({"export", out, "--as", "xyz"}).code, 4);
}

TEST_F(Outputs, OnAFullDiskAreNoSuccess) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string mine = setup(), quiet = " 2> " + in_folder("said");
  for (const std::string& line :
       {"add " + mine + " clamp_dry_friction", "run " + mine + " --set run.duration=0.1s", "theory " + mine,
        std::string("effects")}) {
    EXPECT_EQ(code_of(line + " > /dev/full" + quiet), 4) << line;
    EXPECT_NE(contents(folder / "said").find("standard output: cannot be written"), std::string::npos)
        << line;
  }
  // What is said beside the results is no result.
  EXPECT_EQ(code_of("run " + mine + " --set run.duration=0.1s --json " + in_folder("a.json") + " > " +
                    in_folder("out") + " 2> /dev/full"),
            0);
  EXPECT_EQ(code_of("run " + mine + " --json > " + in_folder("out") + " 2> /dev/full"), 4);
}
