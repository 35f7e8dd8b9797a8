// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "effects.hpp"
#include "experiment_file.hpp"
#include "measured_file.hpp"
#include "measurement.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

namespace fs = std::filesystem;

class ExperimentFile : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  Experiment parse(const std::string& text) {
    return parse_experiment(text, "experiment.toml", folder_.path());
  }
  std::string message_of(const std::string& text) {
    try {
      parse(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const ScratchFolder folder_;
  const std::string columns_ =
      "[column.time]\nfrom = \"t_s\"\nunit = \"s\"\n[column.box_position]\nfrom = \"x\"\nunit = "
      "\"mm\"\nuncertainty = \"0.2 mm\"\n";
  const std::string centre_ =
      "[column.grain_centre]\nfrom = \"c\"\nunit = \"mm\"\nuncertainty = \"0.5 mm\"\n";
  const std::string good_ =
      "t_s,x,c\n0,107,118\n0.002,106,117\n0.004,,116\n0.008,104,115\n0.01,103,\n0.012,102,113\n";
};

TEST_F(ExperimentFile, SeveralRunsWithTheirOwnKeys) {
  write("a.csv", good_);
  write("b.csv", "t_s,x\n0,107\n0.004,106\n0.008,105\n0.012,104\n0.016,103\n");
  const Experiment experiment =
      parse("title = \"two runs\"\n" + columns_ + centre_ +
            "[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\ninitial_grains = \"init.csv\"\n"
            "[[run]]\nfile = \"b.csv\"\nbox_length = \"65 mm\"\ngrains.count = 0\nrelease.displacement = "
            "\"90 mm\"\n");
  ASSERT_EQ(experiment.runs.size(), 2u);
  EXPECT_EQ(experiment.title, "two runs");
  const MeasuredRun &a = experiment.runs[0], &b = experiment.runs[1];
  EXPECT_EQ(a.name, "a");
  EXPECT_DOUBLE_EQ(a.box_length, 0.04);
  EXPECT_DOUBLE_EQ(a.x_box[0], 0.107);
  EXPECT_TRUE(std::isnan(a.x_box[2]) && std::isnan(a.x_com[4]));
  EXPECT_EQ(a.time.size(), 6u);  // the frame lost at 0.006 s stays lost
  EXPECT_DOUBLE_EQ(a.box_uncertainty, 2e-4);
  EXPECT_DOUBLE_EQ(a.com_uncertainty, 5e-4);
  EXPECT_FALSE(b.has_com());
  WITHIN(b.frame_rate, 250, 1e-12, 5.6e-14);
  const shakedown::Setup setup = setup_of_run(shakedown::Setup{}, b, all_effects());
  EXPECT_DOUBLE_EQ(setup.box.length, 0.065);
  EXPECT_EQ(setup.grains.count, 0);
  EXPECT_DOUBLE_EQ(setup.release.displacement, 0.09);
  EXPECT_EQ(a.overrides[1].key, "release.initial_grains");
}

TEST_F(ExperimentFile, EveryDefectOfATableIsNamedWithItsLine) {
  const std::string run = columns_ + "[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\n";
  write("a.csv", "t_s,x\n0,107\n0.004,106\n0.002,105\n0.002,105\n0.006,1O4\n,103\n0.010,102\n");
  const std::string message = message_of(run);
  for (const char* part : {"a.csv:4", "runs backwards", "a.csv:5", "stands twice", "a.csv:6",
                           "'1O4' is not a number", "a.csv:7", "the time is missing"})
    EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
}

TEST_F(ExperimentFile, MissingColumnsFilesAndUnits) {
  write("a.csv", "t_s,x_box,c\n0,107,1\n0.002,106,1\n0.004,105,1\n0.006,105,1\n0.008,105,1\n");
  const std::string run = "[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\n";
  EXPECT_NE(message_of(columns_ + run).find("there is no column 'x'"), std::string::npos);
  const std::string typo =
      "[column.time]\nfrom = \"t_s\"\nunit = \"s\"\n[column.box_position]\nfrom = \"x_bax\"\nunit = \"mm\"\n";
  EXPECT_NE(message_of(typo + run).find("did you mean 'x_box'?"), std::string::npos);
  const std::string pixels =
      "[column.time]\nfrom = \"t_s\"\nunit = \"frame\"\n[column.box_position]\nfrom = \"x_box\"\nunit = "
      "\"px\"\n";
  EXPECT_NE(message_of(pixels + run).find("camera.pixel_size"), std::string::npos);
  EXPECT_NE(message_of(pixels + run).find("camera.frame_rate"), std::string::npos);
  EXPECT_NE(message_of("[column.box_position]\nfrom = \"x_box\"\nunit = \"mm\"\n" + run).find("no clock"),
            std::string::npos);
  EXPECT_THROW(parse(columns_ + "[[run]]\nfile = \"none.csv\"\n"), FileError);
  write("a.csv", "t_s,x\n0,107\n2e-310,106\n4e-310,105\n6e-310,105\n8e-310,105\n");
  EXPECT_NE(message_of(columns_ + run).find("more than 1e9 frames a second"), std::string::npos);
}

TEST_F(ExperimentFile, UnknownKeysAreSuggested) {
  write("a.csv", good_);
  const std::string message = message_of("titel = \"x\"\n[camera]\nframerate = \"500 Hz\"\n" + columns_ +
                                         "[[run]]\nfile = \"a.csv\"\nbox_lenght = \"40 mm\"\n");
  for (const char* part : {"titel", "'title'", "'frame_rate'", "'box_length'"})
    EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
  EXPECT_NE(message_of(columns_).find("run: is missing"), std::string::npos);
  const Experiment experiment =
      parse(columns_ + "[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\ngrains.cuont = 5\n");
  try {
    setup_of_run(shakedown::Setup{}, experiment.runs[0], all_effects());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("experiment.toml:11"), std::string::npos) << error.what();
  }
}

TEST_F(ExperimentFile, TracksOfLongTables) {
  fs::copy_file(std::string(TEST_DATA) + "/tables/trackmate_spots.csv", folder_ / "spots.csv");
  const Experiment experiment = parse(
      "[column.time]\nfrom = \"POSITION_T\"\n[column.box_position]\nfrom = \"POSITION_X\"\ntrack = \"0\"\n"
      "[column.grain_centre]\nfrom = \"POSITION_X\"\ntrack = [1, 2]\n[[run]]\nfile = \"spots.csv\"\n");
  const MeasuredRun& run = experiment.runs[0];
  ASSERT_EQ(run.time.size(), 6u);
  WITHIN(run.x_box[0], 0.1075, 4e-16, 2.4e-17);
  WITHIN(run.x_com[0], 0.1195, 5e-16, 2.7e-17);
  EXPECT_TRUE(std::isnan(run.x_com[4]));  // one of its two tracks is lost there
  EXPECT_TRUE(std::isnan(run.box_length));
}

TEST_F(ExperimentFile, RowsOfSeveralTracksReadAsOneNameTheColumnThatTellsThemApart) {
  write("a.csv", "Track n,t_s,x\n1,0,107\n2,0,118\n1,0.002,106\n2,0.002,117\n");
  const std::string message = message_of(columns_ + "[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\n");
  EXPECT_NE(message.find("column 'Track n' tells tracks apart: say which one with track = \"1\""),
            std::string::npos)
      << message;
  EXPECT_EQ(message.find("sort the table"), std::string::npos);
}

TEST_F(ExperimentFile, AFrameOfTheGrainsThatStandsTwiceIsNamed) {
  write("a.csv",
        "track,t_s,x\n1,0,107\n2,0,118\n1,0.002,106\n2,0.002,117\n2,0.002,117\n1,0.004,105\n2,0.004,116\n"
        "1,0.006,104\n2,0.006,115\n1,0.008,103\n2,0.008,114\n");
  const std::string message = message_of(
      "[column.time]\nfrom = \"t_s\"\nunit = \"s\"\n[column.box_position]\nfrom = \"x\"\nunit = "
      "\"mm\"\ntrack = \"1\"\n[column.grain_centre]\nfrom = \"x\"\nunit = \"mm\"\ntrack = "
      "\"2\"\n[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\n");
  EXPECT_NE(message.find("a.csv:6"), std::string::npos) << message;
  EXPECT_NE(message.find("stands twice"), std::string::npos) << message;
}

TEST_F(ExperimentFile, ValuesOfTheWrongKindAreNotPassedOver) {
  write("a.csv", good_);
  const std::string run = "[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\n";
  const auto complains = [&](const std::string& text, const std::string& about) {
    const std::string message = message_of(text);
    EXPECT_NE(message.find(about), std::string::npos) << text << "\n" << message;
  };
  complains("camera = 3\n" + columns_ + run, "where a table is due");
  complains("[column]\ngrain_centre = \"c\"\n" + columns_.substr(columns_.find('\n') + 1) + run,
            "where a table is due");
  complains("[camera]\nframe_rate = \"0 Hz\"\n" + columns_ + run,
            "camera.frame_rate: is 0 Hz (it must be greater than 0 Hz)");
  complains("[camera]\npixel_size = \"0.5 mm\"\n" + columns_ + "origin = \"1,920 px\"\n" + run,
            "is not a number of pixels");
  complains(columns_ + run + "box.length = \"65 mm\"\n", "is said twice");
}

TEST_F(ExperimentFile, TheLengthMayBeSaidAsTheSetupSaysIt) {
  write("a.csv", good_);
  const Experiment experiment = parse(columns_ + "[[run]]\nfile = \"a.csv\"\nbox.length = \"65 mm\"\n");
  EXPECT_DOUBLE_EQ(experiment.runs[0].box_length, 0.065);
}

TEST_F(ExperimentFile, PixelsFramesOriginAndDirection) {
  fs::copy_file(std::string(TEST_DATA) + "/tables/trackpy.csv", folder_ / "trackpy.csv");
  const Experiment experiment = parse(
      "[camera]\nframe_rate = \"50 Hz\"\npixel_size = \"0.2 mm\"\n[column.time]\nfrom = \"frame\"\nunit = "
      "\"frame\"\n"
      "[column.box_position]\nfrom = \"x\"\nunit = \"px\"\ntrack = \"0\"\norigin = \"900 px\"\nreversed = "
      "true\nuncertainty = \"0.5 px\"\n"
      "[[run]]\nfile = \"trackpy.csv\"\nrelease_time = \"20 ms\"\n");
  const MeasuredRun& run = experiment.runs[0];
  // the frame before the release is no part of the motion
  ASSERT_EQ(run.lead_in.time.size(), 1u);
  WITHIN(run.lead_in.x_box[0], -0.1075, 4e-16, 2.4e-17);
  WITHIN(run.lead_in.time[0], -0.02, 9e-17, 4.5e-18);
  WITHIN(run.x_box[0], -0.10672692, 5e-16, 2.8e-17);
  EXPECT_EQ(run.time[0], 0);
  WITHIN(run.box_uncertainty, 1e-4, 4e-19, 2.3e-20);
}

TEST_F(ExperimentFile, WrittenSeriesAreReadBack) {
  write("a.csv", good_);
  Experiment experiment =
      parse(columns_ + centre_ +
            "[[run]]\nfile = \"a.csv\"\nbox_length = \"40 mm\"\nrelease.displacement = \"90 mm\"\n");
  write_measured_run(folder_ / "again.csv", experiment.runs[0]);
  experiment.runs[0].name = "again";
  experiment.runs[0].overrides.push_back(parse_override("run.duration=20s", "--run"));  // bare, as typed
  write_experiment(folder_ / "again.toml", experiment);
  const Experiment again = read_experiment(folder_ / "again.toml");
  EXPECT_EQ(again.runs[0].time.size(), experiment.runs[0].time.size());
  EXPECT_EQ(again.runs[0].x_box[1], experiment.runs[0].x_box[1]);
  EXPECT_TRUE(std::isnan(again.runs[0].x_com[4]));
  ASSERT_EQ(again.runs[0].overrides.size(), 3u);
  EXPECT_EQ(toml_value(experiment.runs[0].overrides.back()), "\"20s\"");
  EXPECT_EQ(again.runs[0].box_uncertainty, 2e-4);
}

}  // namespace
}  // namespace shakedown
