// SPDX-License-Identifier: MIT
// Names of files that lead to pipes, devices, each other's results or to nothing: each is refused at once, in
// one sentence, and nothing is lost.
#include <sys/stat.h>

#include <cmath>
#include <cstdlib>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

constexpr rlim_t briefly = 5;  // s of a core; what waits for a pipe takes none and never ends

class HostileFiles : public WithFolder {
 protected:
  /// A setup whose runs take milliseconds.
  std::string setup() const {
    return file("mine.toml", "grains.count = 3\n[run]\nduration = \"0.2 s\"\nsample_rate = \"100 Hz\"\n");
  }
  /// The outcome, which has this exit code and says this in one line.
  Outcome expect_said(const std::vector<std::string>& arguments, int code, const std::string& said) const {
    const Outcome outcome = shakedown_program(arguments, briefly);
    SCOPED_TRACE(testing::PrintToString(arguments));
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(said), std::string::npos) << outcome.err;
    return outcome;
  }
};

}  // namespace

TEST_F(HostileFiles, PipesAndDevicesAreNoInputs) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder / "pipe.csv").c_str(), 0600), 0);
  for (const std::string& input : {in_folder("pipe"), std::string("/dev/zero")})
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"run", input},
                                               {"theory", input},
                                               {"import", input, "--out", in_folder("x.toml")},
                                               {"bounce", input},
                                               {"plot", input, "--out", in_folder("x.svg")},
                                               {"report", input, "--out", in_folder("x.html")},
                                               {"add", input, "clamp_dry_friction"},
                                               {"compare", setup(), "--data", input},
                                               {"diagnose", setup(), "--data", input},
                                               {"merge", in_folder("all.sqlite"), input},
                                               {"run", setup(), "--set", "release.initial_grains=" + input}})
      expect_said(arguments, 4, "is a pipe or a device");
  expect_said({"run", file("table.toml",
                           "grains.count = 0\n[[effect]]\nname = \"user_force\"\ntable = \"pipe.csv\"\n")},
              4, "is a pipe or a device");
}

TEST_F(HostileFiles, WhatAShellHandsOverIsRead) {
  const std::string line = "cat " + setup() + " | " + SHAKEDOWN + " run /dev/stdin --json > " +
                           in_folder("a.json") + " 2> " + in_folder("err");
  EXPECT_EQ(std::system(line.c_str()), 0) << contents(folder / "err");
}

TEST_F(HostileFiles, DevicesAreNoOutputs) {
  for (const char* option : {"--json", "--report"})
    expect_said({"run", setup(), option, "/dev/null"}, 4, "it is a device or a pipe");
}

TEST_F(HostileFiles, OneCommandsResultsDoNotReplaceEachOther) {
  const std::string mine = setup(), same = in_folder("same"), out = in_folder("k");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"run", mine, "--json", same, "--report", in_folder("./same")},
           {"theory", mine, "--out", same, "--json", same},
           {"run", mine, "--out", out, "--json", out},
           {"bounce", mine, "--known", same, "--json", same},
           {"check", "linear-decay", "--baselines", same, "--update", "--json", same},
           {"import", file("b.csv", "frame,x_px\n0,9\n1,8\n2,7\n"), "--json=experiment.toml"},
           {"sweep", mine, "--vary", "box.length=40mm,50mm", "--table", same, "--json", same},
           {"import", file("a.csv", "frame,x_px\n0,9\n1,8\n2,7\n"), "--out", same, "--json", same}})
    expect_said(arguments, 2, "one would replace the other");
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"run", mine, "--out", out, "--report", out + "/setup.toml"},
           {"hide", mine, "--out", out, "--truth", out + "/experiment.toml"},
           {"run", mine, "--out", out, "--json", out + "/../k/provenance.json"},
           {"hide", mine, "--out", out, "--json", out + "/truth.json"}})
    expect_said(arguments, 2, "where this command's results may go");
  EXPECT_FALSE(fs::exists(same));
  EXPECT_FALSE(fs::exists(out));
  const Outcome outcome = shakedown_program(
      {"run", mine, "--out", out, "--report", out + "/page.html", "--json", out + "/summary.json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string before = contents(folder / "k/summary.json");
  EXPECT_EQ(shakedown_program({"report", out, "--out", out + "/summary.json"}).code, 4);
  EXPECT_EQ(contents(folder / "k/summary.json"), before);
  for (const char* page : {"/page.html", "/page.htm", "/page.htm"})  // over its own too
    EXPECT_EQ(shakedown_program({"report", out, "--out", out + page}).code, 0) << page;
}

TEST_F(HostileFiles, NamesWithControlCharactersAreRefused) {
  const std::string mine = in_folder("e\033[31m.toml");
  fs::copy_file(setup(), mine);
  const Outcome outcome = expect_said({"run", mine}, 2, "has control characters");
  EXPECT_NE(outcome.err.find("e\\x1b[31m.toml"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out.find('\033'), std::string::npos);
  EXPECT_EQ(outcome.err.find('\033'), std::string::npos);
  expect_said({"run", in_folder("e\u009b31m.toml")}, 2, "e\\xc2\\x9b31m.toml");
  expect_said({"run", in_folder("e\r.toml")}, 2, "e\\x0d.toml");
}

TEST_F(HostileFiles, AnotherExportLeavesNoFramesOfTheFirst) {
  ASSERT_EQ(shakedown_program({"run", setup(), "--log", "--out", in_folder("k")}).code, 0);
  const auto frames = [&](const char* rate) {
    EXPECT_EQ(
        shakedown_program({"export", in_folder("k"), "--as", "vtp", "--rate", rate, "--out", in_folder("x")})
            .code,
        0);
    return std::distance(fs::directory_iterator(folder / "x/frames"), {});
  };
  const auto many = frames("100Hz"), few = frames("20Hz");
  EXPECT_GT(many, 30);
  EXPECT_LT(few, many / 3);
}

TEST_F(HostileFiles, WhatCannotBeReadHasItsReason) {
  fs::create_symlink("loop", folder / "loop");
  expect_said({"import", in_folder("nofile.csv")}, 4, "No such file");
  expect_said({"import", in_folder("loop")}, 4, "Too many levels");
  expect_said({"import", in_folder("")}, 4, "is a folder");
  expect_said({"run", setup(), "--set", "release.initial_grains=nofile.csv"}, 4,
              "(release.initial_grains, No such file");
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"import", ""},
                                             {"bounce", ""},
                                             {"run", ""},
                                             {"export", ""},
                                             {"report", ""},
                                             {"plot", "", "--out", "x.svg"}}) {
    const Outcome outcome = shakedown_program(arguments, briefly);
    EXPECT_TRUE(outcome.code == 4 || outcome.code == 2) << outcome.err;
    EXPECT_NE(outcome.err.find("empty"), std::string::npos) << arguments[0] << ": " << outcome.err;
  }
  expect_said({"run", setup(), "--keep", ""}, 2, "has an empty name");
}

TEST_F(HostileFiles, ALineWithAZeroByteIsNoText) {
  expect_said({"import", file("a.csv", std::string("time_s,x_m\n0,0.1\n0.01,\0 0.1\n", 27))}, 2,
              "a.csv:3:1: is not text");
}

TEST_F(HostileFiles, WithoutASpringNothingIsCompared) {
  const std::string film = file("film.toml",
                                "[column.box_position]\nfrom = \"x_m\"\nunit = \"m\"\n[camera]\n"
                                "frame_rate = \"100 Hz\"\n[[run]]\nfile = \"a.csv\"\n");
  std::string rows = "x_m\n";
  for (int frame = 0; frame < 200; ++frame) rows += std::to_string(0.1 * std::cos(0.08 * frame)) + "\n";
  file("a.csv", rows);
  const std::string gas =
      file("gas.toml", "domain.kind = \"closed\"\ngrains.count = 8\nbox.length = \"60 mm\"\n");
  for (const char* command : {"compare", "diagnose", "ladder"})
    expect_said({command, gas, "--data", film}, 2, "has no spring");
  expect_said({"fit", gas, "--data", film, "--free", "restitution.grain_grain"}, 2, "has no spring");
}

TEST_F(HostileFiles, ABoxWithoutGrainsHasNoNumbersOfThem) {
  const std::string empty = file("empty.toml", "grains.count = 0\n[run]\nduration = \"4 s\"\n");
  ASSERT_EQ(
      shakedown_program({"hide", empty, "--engine", "hard", "--lengths", "40mm", "--out", in_folder("film")})
          .code,
      0);
  const std::vector<std::string> film{in_folder("film/setup.toml"), "--data",
                                      in_folder("film/experiment.toml")};
  for (const char* command : {"compare", "diagnose"}) {
    const Outcome outcome = shakedown_program({command, film[0], film[1], film[2]});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("0.000         -"), std::string::npos) << outcome.out;
  }
}

TEST_F(HostileFiles, ARestitutionOfZeroIsARunLikeAnother) {
  const Outcome outcome = shakedown_program(
      {"run", setup(), "--set", "restitution.grain_grain=0", "--set", "restitution.grain_wall=0", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(HostileFiles, WhatMayNotBeReadOrWrittenIsToldAndNothingIsLeft) {
  const std::string mine = setup(), secret = in_folder("secret.toml"), shut = in_folder("shut");
  fs::copy_file(mine, secret);
  fs::create_directory(shut);
  fs::permissions(folder / "", fs::perms(0755));
  fs::permissions(mine, fs::perms(0644));
  fs::permissions(secret, fs::perms(0));
  fs::permissions(shut, fs::perms(0555));
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"run", secret},
                                             {"run", mine, "--out", shut + "/results"},
                                             {"run", mine, "--out", shut},
                                             {"run", mine, "--json", shut + "/run.json"},
                                             {"add", mine, "grain_friction", "--out", shut + "/more.toml"},
                                             {"theory", mine, "--json", shut + "/theory.json"}}) {
    const Outcome outcome = program_of_nobody(arguments);
    SCOPED_TRACE(testing::PrintToString(arguments));
    if (outcome.code == 127) GTEST_SKIP() << "nobody may not reach the program here";
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("Permission denied"), std::string::npos) << outcome.err;
    EXPECT_TRUE(fs::is_empty(shut));
  }
}
