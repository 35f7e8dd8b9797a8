// SPDX-License-Identifier: MIT
// run --log, export and report, as a user types them.
#include "program.hpp"

namespace fs = std::filesystem;

class ReportCommand : public WithFolder {
 protected:
  /// A short run with its log and a report, in folder "run".
  Outcome logged_run() const {
    return shakedown_program({"run", example("L040.toml"), "--set", "run.duration=0.5s", "--out",
                              in_folder("run"), "--log", "--report", in_folder("run.html")});
  }
};

TEST_F(ReportCommand, ALoggedRunIsExportedAndShown) {
  const Outcome run = logged_run();
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("report: open "), std::string::npos) << run.out;
  EXPECT_TRUE(fs::exists(in_folder("run/collisions.log")));
  const Outcome exported = shakedown_program(
      {"export", in_folder("run"), "--as", "csv", "--rate", "1kHz", "--from", "0.1s", "--to", "0.2s"});
  ASSERT_EQ(exported.code, 0) << exported.err;
  EXPECT_NE(exported.out.find("101 frames of 37 grains"), std::string::npos) << exported.out;
  EXPECT_TRUE(fs::exists(in_folder("run/export/motion.csv")));
  const Outcome again = shakedown_program({"report", in_folder("run"), "--out", in_folder("again.html")});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(contents(in_folder("again.html")), contents(in_folder("run.html")));
}

TEST_F(ReportCommand, TheLogIsTheSameForAnyNumberOfThreads) {
  for (const std::string threads : {"1", "2"})
    ASSERT_EQ(
        shakedown_program({"run", example("L065.toml"), "--set", "run.duration=0.3s", "--runs", "3",
                           "--threads", threads, "--log", "--every-series", "--out", in_folder(threads)})
            .code,
        0);
  for (const std::string name : {"collisions.log", "collisions/run_0000.log", "collisions/run_0002.log"})
    EXPECT_EQ(contents(in_folder("1/" + name)), contents(in_folder("2/" + name))) << name;
  EXPECT_EQ(contents(in_folder("1/collisions.log")), contents(in_folder("1/collisions/run_0000.log")));
}

TEST_F(ReportCommand, ResultsOfOneNameAreToldApartByTheirPaths) {
  for (const std::string place : {"a/r1", "b/r1", "other"})
    ASSERT_EQ(shakedown_program(
                  {"run", example("L040.toml"), "--set", "run.duration=0.1s", "--out", in_folder(place)})
                  .code,
              0);
  const Outcome all = shakedown_program(
      {"report", in_folder("a/r1"), in_folder("b/r1/"), in_folder("other"), "--out", in_folder("all.html")});
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_NE(contents(in_folder("all.html"))
                .find("<title>" + in_folder("a/r1") + ", " + in_folder("b/r1") + ", other"),
            std::string::npos);
}

TEST_F(ReportCommand, WhatCannotBeLoggedIsNamed) {
  const Outcome nowhere = shakedown_program({"run", example("L040.toml"), "--log"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_NE(nowhere.err.find("--out DIR"), std::string::npos) << nowhere.err;
  const Outcome soft = shakedown_program(
      {"run", example("L040.toml"), "--log", "--engine", "soft", "--out", in_folder("soft")});
  EXPECT_EQ(soft.code, 2);
  EXPECT_NE(soft.err.find("--engine hard"), std::string::npos) << soft.err;
  const Outcome series = shakedown_program({"run", example("L040.toml"), "--runs", "2", "--every-series"});
  EXPECT_EQ(series.code, 2);
  EXPECT_NE(series.err.find("--every-series: has nowhere to be written"), std::string::npos) << series.err;
}

TEST_F(ReportCommand, MistakesOfExportAreNamed) {
  ASSERT_EQ(logged_run().code, 0);
  EXPECT_EQ(shakedown_program({"export", in_folder("nothing")}).code, 4);
  EXPECT_EQ(shakedown_program({"export", in_folder("run"), "--as", "mp4"}).code, 2);
  EXPECT_EQ(shakedown_program({"export", in_folder("run"), "--rate", "10 mm"}).code, 2);
  const Outcome late = shakedown_program({"export", in_folder("run"), "--from", "3s"});
  EXPECT_EQ(late.code, 2);
  EXPECT_NE(late.err.find("0.5 s"), std::string::npos) << late.err;
  EXPECT_EQ(shakedown_program({"report", in_folder("nothing")}).code, 4);
}

class SlowReportCommand : public ReportCommand {};

TEST_F(SlowReportCommand, ComparisonsLaddersFitsAndSweepsAreShownAlone) {
  ASSERT_EQ(shakedown_program({"hide", example("L040.toml"), "--engine", "hard", "--lengths", "40mm,65mm",
                               "--duration", "3 s", "--out", in_folder("case")})
                .code,
            0);
  const std::string setup = in_folder("case/setup.toml"), data = in_folder("case/experiment.toml");
  const std::vector<std::pair<std::string, std::vector<std::string>>> commands{
      {"compare", {"compare", setup, "--data", data, "--runs", "16"}},
      {"ladder", {"ladder", setup, setup, "--data", data, "--runs", "16"}},
      {"fit",
       {"fit", setup, "--data", data, "--free", "restitution.grain_wall", "--on", "L040", "--runs", "32"}}};
  for (const auto& [name, words] : commands) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--out", in_folder(name), "--report", in_folder(name + ".html")});
    const Outcome made = shakedown_program(all);
    ASSERT_LE(made.code, 1) << made.err;
    EXPECT_NE(made.out.find("report: open "), std::string::npos) << made.out;
    EXPECT_TRUE(fs::exists(in_folder(name + "/" + name + ".json")));
    ASSERT_EQ(shakedown_program({"report", in_folder(name), "--out", in_folder("again.html")}).code, 0);
    EXPECT_EQ(contents(in_folder("again.html")), contents(in_folder(name + ".html"))) << name;
  }
  const Outcome swept =
      shakedown_program({"sweep", example("L040.toml"), "--vary", "box.length=40:80:10 mm", "--vary",
                         "restitution.grain_grain=0.6:0.9:0.1", "--set", "run.duration=1 s", "--out",
                         in_folder("sweep.sqlite"), "--report", in_folder("sweep.html")});
  ASSERT_EQ(swept.code, 0) << swept.err;
  const Outcome all = shakedown_program(
      {"report", in_folder("sweep.sqlite"), in_folder("fit/"), "--out", in_folder("all.html")});
  ASSERT_EQ(all.code, 0) << all.err;
  EXPECT_NE(contents(in_folder("all.html")).find("fit: Parameters"), std::string::npos);
  EXPECT_NE(contents(in_folder("all.html")).find("sweep.sqlite: What changes"), std::string::npos);
}

TEST_F(ReportCommand, DiagnoseKeepsWhatIsKnownOtherwise) {
  ASSERT_EQ(shakedown_program({"hide", example("L040.toml"), "--engine", "hard", "--lengths", "40mm",
                               "--duration", "2 s", "--camera", "fps=100", "--out", in_folder("case")})
                .code,
            0);
  const Outcome wrong = shakedown_program(
      {"diagnose", in_folder("case/setup.toml"), "--data", in_folder("case/experiment.toml"), "--effects",
       "grain_friction, friction", "--fixed", "spring.frequency, box.mass"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(wrong.err.starts_with("--effects: friction: is not an effect")) << wrong.err;
  EXPECT_NE(wrong.err.find("\n--fixed: box.mass: "), std::string::npos) << wrong.err;
}
