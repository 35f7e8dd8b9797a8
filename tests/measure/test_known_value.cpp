// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "effects.hpp"
#include "experiment_file.hpp"
#include "measured_file.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

namespace fs = std::filesystem;

/// [known] with these lines, and what is wrong with them.
struct ReadKnown {
  std::vector<KnownValue> values;
  std::string wrong;
};

ReadKnown known_of_text(const std::string& lines, KnownEffects effects = {}) {
  ReadKnown result;
  std::vector<Violation> violations;
  result.values = read_known(parse_toml(lines, "experiment.toml"), "known.", violations, effects);
  for (const Violation& violation : violations) result.wrong += to_string(violation) + "\n";
  return result;
}

void expect_value(const std::string& line, double value, double error) {
  const ReadKnown read = known_of_text(line);
  ASSERT_EQ(read.values.size(), 1u) << line << "\n" << read.wrong;
  EXPECT_TRUE(read.wrong.empty()) << read.wrong;
  EXPECT_DOUBLE_EQ(read.values[0].value, value) << line;
  EXPECT_DOUBLE_EQ(read.values[0].error, error) << line;
  EXPECT_EQ(read.values[0].place.line, 1);
}

TEST(KnownValue, IsAValueWithItsErrorAndTheUnitOnceOrTwice) {
  expect_value("\"box.mass\" = \"434 g +- 2 g\"", 0.434, 0.002);
  expect_value("\"box.mass\" = \"434 +- 2 g\"", 0.434, 0.002);
  expect_value("\"box.mass\" = \"434 g +- 2\"", 0.434, 0.002);
  expect_value("\"box.mass\" = \"(434 +- 2) g\"", 0.434, 0.002);
  expect_value("\"box.mass\" = \"0.434 kg \u00b1 2 g\"", 0.434, 0.002);
  expect_value("\"box.mass\" = \"400 g +- 0.5 %\"", 0.4, 0.002);
  expect_value("box.mass = \"434g+-2g\"", 0.434, 0.002);
  expect_value("\"restitution.grain_grain\" = \"0.95 +- 0.02\"", 0.95, 0.02);
  expect_value("\"restitution.grain_grain\" = \"95 +- 2 %\"", 0.95, 0.02);
  expect_value("\"camera.scale\" = \"0 +- 0.5 %\"", 0, 0.005);
  expect_value("\"camera.trigger\" = \"0 +/- 2 ms\"", 0, 0.002);
  expect_value("\"camera.wander_time\" = \"0.3 s +- 0.1 s\"", 0.3, 0.1);
  expect_value("\"release.displacement\" = \"-107.5 mm +- 5e-1 mm\"", -0.1075, 0.0005);
  expect_value("\"clock\" = \"0 +- 0.01 %\"", 0, 1e-4);
}

TEST(KnownValue, IsANumberOfAnEffectInsideTheContacts) {
  const ReadKnown read = known_of_text(
      "\"grain_friction.grain_wall\" = \"0.2 +- 0.03\"\n"
      "\"velocity_dependent_restitution.reference_speed\" = \"2 m/s +- 0\"\n",
      all_effects());
  ASSERT_EQ(read.values.size(), 2u) << read.wrong;
  EXPECT_DOUBLE_EQ(read.values[0].value, 0.2);
  EXPECT_DOUBLE_EQ(read.values[0].error, 0.03);
  EXPECT_DOUBLE_EQ(read.values[1].value, 2);
  EXPECT_EQ(known_line(read.values[0], all_effects()), "\"grain_friction.grain_wall\" = \"0.2 +- 0.03\"");
  EXPECT_FALSE(may_differ_between_runs("grain_friction.grain_wall"));
  // The balance tells what acts on the box; a law is no number.
  EXPECT_NE(known_of_text("\"clamp_dry_friction.force\" = \"8 mN +- 1 mN\"", all_effects())
                .wrong.find("the films themselves tell"),
            std::string::npos);
  EXPECT_NE(known_of_text("\"velocity_dependent_restitution.law\" = \"0.1 +- 0.1\"", all_effects())
                .wrong.find("is no number of that effect"),
            std::string::npos);
}

TEST(KnownValue, WrongOnesSayWhatToWrite) {
  const auto expect_message = [](const std::string& line, const std::vector<std::string>& parts) {
    const ReadKnown read = known_of_text(line);
    EXPECT_TRUE(read.values.empty()) << line;
    for (const std::string& part : parts) EXPECT_NE(read.wrong.find(part), std::string::npos) << read.wrong;
  };
  expect_message("\"box.mass\" = \"434 g\"",
                 {"experiment.toml:1", "known.box.mass", "has no error", "+- 1 g"});
  expect_message("\"box.mass\" = 0.434", {"a text with value and error is expected"});
  expect_message("\"box.mass\" = \"434 mm +- 2 mm\"", {"a mass"});
  expect_message("\"box.mass\" = \"434 g +- 2 mm\"", {"the error", "a mass"});
  expect_message("\"box.mass\" = \"434 g +- -2 g\"", {"no standard deviation"});
  expect_message("\"box.mass\" = \"-434 g +- 2 g\"", {"must be greater than 0 g"});
  expect_message("\"box.mas\" = \"434 g +- 2 g\"", {"did you mean 'box.mass'?"});
  expect_message("mass = \"434 g +- 2 g\"", {"did you mean 'box.mass' or 'grains.mass'?"});
  expect_message("\"camera.scales\" = \"0 +- 1 %\"", {"did you mean 'camera.scale'?"});
  expect_message("\"run.seed\" = \"1 +- 0\"", {"only steers a simulation"});
  expect_message("\"release.packing\" = \"1 +- 0\"", {"is not a number"});
  expect_message("\"restitution.grain_grain\" = \"0.95 +- 2 %\"", {"of what the per cent is", "95 % +- 2 %"});
  expect_message("\"camera.wander\" = \"-1 um +- 1 um\"", {"at least 0 mm"});
  const ReadKnown twice = known_of_text("\"box.mass\" = \"434 g +- 2 g\"\n[box]\nmass = \"434 g +- 2 g\"\n");
  EXPECT_NE(twice.wrong.find("is said twice"), std::string::npos) << twice.wrong;
}

class KnownInExperiment : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "a.csv") << "t,x\n0,107\n0.004,106\n0.008,105\n0.012,104\n0.016,103\n";
  }
  Experiment parse(const std::string& text) {
    return parse_experiment(columns_ + text, "experiment.toml", folder_.path());
  }

  const ScratchFolder folder_;
  const std::string columns_ =
      "[column.time]\nfrom = \"t\"\nunit = \"s\"\n[column.box_position]\nfrom = \"x\"\nunit = \"mm\"\n";
};

TEST_F(KnownInExperiment, ARunsOwnValueGoesBeforeTheFiles) {
  const Experiment experiment = parse(
      "[known]\n\"box.mass\" = \"434 g +- 2 g\"\n\"camera.scale\" = \"0 +- 0.5 %\"\n"
      "[[run]]\nfile = \"a.csv\"\n"
      "[[run]]\nfile = \"a.csv\"\n[run.known]\n\"box.mass\" = \"450 g +- 1 g\"\n");
  const std::vector<KnownValue> first = known_of(experiment, experiment.runs[0]),
                                second = known_of(experiment, experiment.runs[1]);
  ASSERT_EQ(first.size(), 2u);
  ASSERT_EQ(second.size(), 2u);
  EXPECT_DOUBLE_EQ(find_known(first, "box.mass")->value, 0.434);
  EXPECT_DOUBLE_EQ(find_known(second, "box.mass")->value, 0.45);
  EXPECT_DOUBLE_EQ(find_known(second, "camera.scale")->error, 0.005);
  EXPECT_TRUE(is_of_each_run("release.displacement") && is_of_each_run("camera.trigger"));
  EXPECT_FALSE(is_of_each_run("box.mass") || is_of_each_run("camera.scale"));
}

TEST(KnownValue, AnErrorThatNothingWeighsIsRefusedWithTheLine) {
  const ReadKnown read = known_of_text("\"box.length\" = \"40 mm +- 0.1 mm\"");
  EXPECT_TRUE(read.values.empty());
  for (const char* part :
       {"experiment.toml:1", "known.box.length", "nothing here weighs", "box.mass", "40 mm"})
    EXPECT_NE(read.wrong.find(part), std::string::npos) << read.wrong;
  expect_value("\"box.length\" = \"40 mm +- 0 mm\"", 0.04, 0);
}

TEST_F(KnownInExperiment, WhatAllRunsHaveInCommonIsNotSaidOfOne) {
  try {
    parse("[[run]]\nfile = \"a.csv\"\n[run.known]\n\"restitution.grain_wall\" = \"0.9 +- 0.01\"\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("same in all runs"), std::string::npos) << error.what();
  }
}

TEST_F(KnownInExperiment, TheClockIsPutRight) {
  const Experiment experiment = parse("[known]\nclock = \"10 % +- 0.1 %\"\n[[run]]\nfile = \"a.csv\"\n");
  WITHIN(experiment.runs[0].time.back(), 0.016 * 1.1, 8e-17, 4e-18);
}

TEST_F(KnownInExperiment, ARunMayStartAnywhere) {
  const Experiment experiment = parse(
      "[[run]]\nfile = \"a.csv\"\nrelease = \"unknown\"\n[[run]]\nfile = \"a.csv\"\n"
      "[[run]]\nfile = \"a.csv\"\nrelease = \"at rest\"\n"
      "[[run]]\nfile = \"a.csv\"\nrelease.displacement = \"90 mm\"\n");
  shakedown::Setup with_grains, empty;
  empty.grains.count = 0;
  const auto anywhere = [&](std::size_t run, const shakedown::Setup& setup) {
    return starts_anywhere(experiment.runs[run], setup);
  };
  EXPECT_TRUE(anywhere(0, with_grains) && anywhere(0, empty));
  EXPECT_TRUE(!anywhere(1, with_grains) && anywhere(1, empty));
  EXPECT_TRUE(!anywhere(2, with_grains) && !anywhere(2, empty));
  EXPECT_TRUE(!anywhere(3, with_grains) && anywhere(3, empty));
  EXPECT_EQ(experiment.runs[3].overrides.at(0).key, "release.displacement");
  EXPECT_THROW(parse("[[run]]\nfile = \"a.csv\"\nrelease = \"unkown\"\n"), InputError);
}

TEST_F(KnownInExperiment, ComesBackFromTheFileThatIsWritten) {
  const Experiment experiment = parse(
      "[known]\n\"box.mass\" = \"434 g +- 2 g\"\n[[run]]\nfile = \"a.csv\"\nrelease = \"unknown\"\n"
      "known.\"camera.trigger\" = \"1 ms +- 2 ms\"\n");
  for (const MeasuredRun& run : experiment.runs) write_measured_run(folder_ / (run.name + ".csv"), run);
  write_experiment(folder_ / "written.toml", experiment);
  const Experiment back = read_experiment(folder_ / "written.toml");
  ASSERT_EQ(back.known.size(), 1u);
  EXPECT_DOUBLE_EQ(back.known[0].error, 0.002);
  ASSERT_EQ(back.runs[0].known.size(), 1u);
  EXPECT_DOUBLE_EQ(back.runs[0].known[0].value, 0.001);
  EXPECT_EQ(back.runs[0].start, Start::anywhere);
}

TEST_F(KnownInExperiment, ChangesTheDigest) {
  const std::string run = "[[run]]\nfile = \"a.csv\"\n";
  const std::string without = digest(parse(run));
  const std::string with = digest(parse("[known]\n\"box.mass\" = \"434 g +- 2 g\"\n" + run));
  const std::string other = digest(parse("[known]\n\"box.mass\" = \"434 g +- 3 g\"\n" + run));
  EXPECT_NE(without, with);
  EXPECT_NE(with, other);
}

TEST_F(KnownInExperiment, MistakesAreNamedWithTheirLine) {
  try {
    parse("[known]\n\"box.mas\" = \"434 g +- 2 g\"\n[[run]]\nfile = \"a.csv\"\nknown.clock = \"3\"\n");
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("experiment.toml:8"), std::string::npos) << message;
    EXPECT_NE(message.find("run.known.clock"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace shakedown
