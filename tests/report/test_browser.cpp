// SPDX-License-Identifier: MIT
// A report in headless Chromium (browser_check.mjs): one request, ready in time, every plot drawn, the grains
// move, both themes and widths.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "scratch_folder.hpp"

namespace fs = std::filesystem;

namespace {

int status_of(const std::string& command) { return std::system(command.c_str()) >> 8; }

/// Empty when the check can be made.
std::string what_is_missing() {
  if (!fs::exists("/usr/bin/chromium")) return "Chromium is not installed (apt-get install chromium)";
  if (status_of("node --version > /dev/null 2>&1") != 0) return "node is not installed";
  if (!fs::exists(fs::path(BROWSER_MODULES) / "playwright-core"))
    return "playwright-core is not there (tests/run fetches it with npm)";
  return "";
}

int check(const fs::path& report) {
  return status_of("BROWSER_MODULES='" BROWSER_MODULES "' node " PROJECT_ROOT
                   "/tests/report/browser_check.mjs " +
                   report.string());
}

}  // namespace

TEST(SlowBrowser, ShowsARunWithItsGrains) {
  if (const std::string missing = what_is_missing(); !missing.empty()) GTEST_SKIP() << missing;
  const shakedown::ScratchFolder folder;
  const fs::path report = folder / "run.html";
  ASSERT_EQ(status_of(SHAKEDOWN " run " PROJECT_ROOT "/harness/examples/L065.toml --report " +
                      report.string() + " > /dev/null"),
            0);
  EXPECT_LT(fs::file_size(report), 1'500'000u);
  EXPECT_EQ(check(report), 0);
}

TEST(SlowBrowser, ShowsAStudyOfFourLengthsWithAHiddenEffect) {
  if (const std::string missing = what_is_missing(); !missing.empty()) GTEST_SKIP() << missing;
  const shakedown::ScratchFolder folder;
  const fs::path study = folder / "study", report = folder / "study.html";
  ASSERT_EQ(
      status_of(SHAKEDOWN " hide " PROJECT_ROOT "/harness/examples/L040.toml --effect blade_viscous_damping "
                          "--lengths 40mm,65mm,85mm,104mm --engine hard "
                          "--duration '10 s' --out " +
                study.string() + " > /dev/null"),
      0);
  const int rejected = status_of(SHAKEDOWN " compare " + (study / "setup.toml").string() + " --data " +
                                 (study / "experiment.toml").string() + " --runs 32 --report " +
                                 report.string() + " > /dev/null");
  ASSERT_LE(rejected, 1);
  EXPECT_LT(fs::file_size(report), 1'500'000u);
  EXPECT_EQ(check(report), 0);
}

TEST(SlowBrowser, ShowsADiagnosisOfABoxAloneWithItsKnobs) {
  if (const std::string missing = what_is_missing(); !missing.empty()) GTEST_SKIP() << missing;
  const shakedown::ScratchFolder folder;
  const fs::path report = folder / "ring_down.html";
  ASSERT_EQ(status_of("cd " TEST_DATA "/leaf_spring && " SHAKEDOWN
                      " diagnose setup.toml --data experiment.toml --report " +
                      report.string() + " > /dev/null 2>&1"),
            1);
  EXPECT_EQ(check(report), 0);
}

TEST(SlowBrowser, ShowsADiagnosisWithGrainsAndItsKnobs) {
  if (const std::string missing = what_is_missing(); !missing.empty()) GTEST_SKIP() << missing;
  const shakedown::ScratchFolder folder;
  const fs::path study = folder / "study", report = folder / "diagnosis.html";
  ASSERT_EQ(status_of(SHAKEDOWN " hide " PROJECT_ROOT
                                "/harness/examples/L040.toml --effect blade_viscous_damping --engine hard "
                                "--duration '6 s' --out " +
                      study.string() + " > /dev/null"),
            0);
  ASSERT_LE(status_of(SHAKEDOWN " diagnose " + (study / "setup.toml").string() + " --data " +
                      (study / "experiment.toml").string() + " --seconds 60 --report " + report.string() +
                      " > /dev/null 2>&1"),
            1);
  EXPECT_LT(fs::file_size(report), 1'800'000u);
  EXPECT_EQ(check(report), 0);
}

TEST(SlowBrowser, ShowsASweepWithoutGrains) {
  if (const std::string missing = what_is_missing(); !missing.empty()) GTEST_SKIP() << missing;
  const shakedown::ScratchFolder folder;
  const fs::path report = folder / "sweep.html", results = folder / "sweep.sqlite";
  ASSERT_EQ(status_of(SHAKEDOWN " sweep " PROJECT_ROOT
                                "/harness/examples/L040.toml --vary box.length=40:80:10mm --vary "
                                "restitution.grain_grain=0.6:0.9:0.1 --set 'run.duration=3 s' --out " +
                      results.string() + " --report " + report.string() + " > /dev/null 2>&1"),
            0);
  EXPECT_EQ(check(report), 0);
}
