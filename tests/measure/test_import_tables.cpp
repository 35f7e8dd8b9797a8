// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>

#include "experiment_file.hpp"
#include "import_tables.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

ImportedTables imported(const std::string& name) {
  const std::string folder = std::string(TEST_DATA) + "/tables";
  return import_tables({folder + "/" + name}, folder);
}

std::string summary(const ImportedTables& tables) {
  std::string text;
  for (const GuessedColumn& column : tables.columns)
    text += column.from + "|" + column.unit + (column.track.empty() ? "" : "|" + column.track) + "; ";
  return text;
}

TEST(ImportTables, KnowsTheLayoutsOfTrackers) {
  EXPECT_EQ(summary(imported("tracker_single.txt")), "t|s; x|m; |; ");
  EXPECT_EQ(summary(imported("tracker_multi.csv")), "t|s; box.x|m; grains.x|m; ");
  EXPECT_EQ(summary(imported("trackmate_spots.csv")),
            "POSITION_T|sec; POSITION_X|micron|0; POSITION_X|micron|1; ");
  EXPECT_EQ(summary(imported("trackpy.csv")), "frame|frame; x|px|0; x|px|3; ");
  EXPECT_EQ(summary(imported("imagej_manual.txt")), "Slice n|frame; X|px|1; |; ");
  EXPECT_EQ(summary(imported("spreadsheet.csv")), "Zeit|ms; x|mm; Schwerpunkt|mm; ");
  EXPECT_EQ(summary(imported("logger.dat")), "t_s|s; x_box_mm|mm; |; ");
}

class ImportedText : public ::testing::Test {
 protected:
  ImportedTables imported_as(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return import_tables({folder_ / name}, folder_.path());
  }
  std::string rows(const std::vector<std::string>& formats) {
    std::string text;
    for (int i = 0; i < 12; ++i) {
      for (std::size_t j = 0; j < formats.size(); ++j)
        text += (j ? "," : "") + (formats[j] == "t"   ? std::to_string(i)
                                  : formats[j] == "x" ? std::to_string(100 - 9 * i)
                                                      : formats[j]);
      text += "\n";
    }
    return text;
  }
  const ScratchFolder folder_;
};

TEST_F(ImportedText, WhatIsToldOnTheCommandLineNeedsNoEditor) {
  std::ofstream(folder_ / "a.csv") << "frame,x_px\n" + rows({"t", "x"});
  std::ofstream(folder_ / "b.csv") << "frame,x_px\n" + rows({"t", "x"});
  const ImportedTables asked = import_tables({folder_ / "a.csv", folder_ / "b.csv"}, folder_.path());
  EXPECT_EQ(asked.open_questions.size(), 2u);  // pixel size and frame rate, once each
  ImportOptions options{"240 Hz", "0.25 mm", "640 px", {"40 mm", "65 mm"}};
  const ImportedTables told = import_tables({folder_ / "a.csv", folder_ / "b.csv"}, folder_.path(), options);
  EXPECT_TRUE(told.open_questions.empty()) << told.open_questions.front();
  const Experiment experiment = parse_experiment(told.experiment, "experiment.toml", folder_.path());
  EXPECT_EQ(experiment.title, "a, b");
  ASSERT_EQ(experiment.runs.size(), 2u);
  WITHIN(experiment.runs[1].box_length, 0.065, 3e-16, 1.5e-17);
  WITHIN(experiment.runs[0].x_box[0], (100 - 640) * 0.25e-3, 6e-16, 3e-17);
  WITHIN(experiment.runs[0].time[1], 1.0 / 240, 1e-17, 9.3e-19);
  options.frame_rate = "240";
  EXPECT_THROW(import_tables({folder_ / "a.csv"}, folder_.path(), options), InputError);
}

TEST_F(ImportedText, TheSecondTrackIsTheGrains) {
  const ImportedTables tables = imported_as("a.csv", "t,box.x,balls.x\n" + rows({"t", "x", "x"}));
  EXPECT_EQ(tables.columns[1].from, "box.x");
  EXPECT_EQ(tables.columns[2].from, "balls.x");
  EXPECT_FALSE(tables.columns[2].certain);
}

TEST_F(ImportedText, LinesOfDelimitersBelowTheTableAreNothing) {
  std::string text = "t_s;x_mm;c_mm\n";
  for (int i = 0; i < 12; ++i) text += std::to_string(i) + ",5;" + std::to_string(100 - 9 * i) + ",25;1,5\n";
  const Table table = parse_table(text + ";;\r\n;;\r\n", "a.csv");
  EXPECT_EQ(table.rows(), 12u);
  EXPECT_TRUE(table.violations.empty());
}

TEST_F(ImportedText, SizesVelocitiesAndCountersAreNoPositions) {
  EXPECT_EQ(summary(imported_as("a.csv", "t_s,box_width_px,box_x_px\n" + rows({"t", "400", "x"}))),
            "t_s|s; box_x_px|px; |; ");
  EXPECT_EQ(summary(imported_as("b.csv", "t_s,box_v_mm_s,box_x_mm\n" + rows({"t", "x", "x"}))),
            "t_s|s; box_x_mm|mm; |; ");
  EXPECT_EQ(summary(imported_as("c.csv", "t_s,index,y\n" + rows({"t", "t", "x"}))), "t_s|s; y|px; |; ");
}

TEST_F(ImportedText, AnUnknownUnitIsAskedForAndNotReplaced) {
  const ImportedTables tables = imported_as("L040.csv", "t_s,x [inch]\n" + rows({"t", "x"}));
  EXPECT_EQ(summary(tables), "t_s|s; x|inch; |; ");
  ASSERT_EQ(tables.open_questions.size(), 1u);
  EXPECT_NE(tables.open_questions[0].find("'inch'"), std::string::npos);
}

TEST_F(ImportedText, TracksOfImageJ) {
  std::string text = " \tTrack n\xB0\tSlice n\xB0\tX\tY\n";
  for (int i = 0; i < 12; ++i)
    for (int track = 1; track <= 2; ++track)
      text += std::to_string(2 * i + track) + "\t" + std::to_string(track) + "\t" + std::to_string(i) + "\t" +
              std::to_string(900 - 9 * i) + "\t512\n";
  EXPECT_EQ(summary(imported_as("L040.txt", text)), "Slice n\xC2\xB0|frame; X|px|1; X|px|2; ");
}

TEST_F(ImportedText, LengthInTheNameOfTheFile) {
  const auto length = [&](const std::string& name) {
    const std::string text = imported_as(name, "t_s,x_box_mm\n" + rows({"t", "x"})).experiment;
    const std::size_t at = text.find("box_length = ");
    return text.substr(at + 13, text.find('\n', at) - at - 13);
  };
  EXPECT_EQ(length("L040_a.csv"), "\"40 mm\"  # from the file's name");
  EXPECT_EQ(length("65 mm.csv"), "\"65 mm\"  # from the file's name");
  EXPECT_EQ(length("L40.25mm.csv"), "\"40.25 mm\"  # from the file's name");
  EXPECT_EQ(length("d10mm_L065.csv"), "\"65 mm\"  # one of the lengths in the file's name; PLEASE CHECK");
  EXPECT_EQ(length("run7.csv"), "\"40 mm\"  # left out: the setup's");
}

TEST(ImportTables, AsksForWhatNobodyCanGuess) {
  const ImportedTables tables = imported("trackpy.csv");
  ASSERT_EQ(tables.open_questions.size(), 3u);  // pixel size, frame rate, box length
  EXPECT_NE(tables.experiment.find("PLEASE CHECK"), std::string::npos);
  EXPECT_THROW(parse_experiment(tables.experiment, "experiment.toml", std::string(TEST_DATA) + "/tables"),
               InputError);
}

TEST(ImportTables, WhatItWritesIsRead) {
  std::string text = imported("tracker_multi.csv").experiment;
  text.replace(text.find("? mm"), 4, "40 mm");
  const Experiment experiment = parse_experiment(text, "experiment.toml", std::string(TEST_DATA) + "/tables");
  EXPECT_EQ(experiment.runs[0].time.size(), 8u);
  EXPECT_TRUE(experiment.runs[0].has_com());
}

}  // namespace
}  // namespace shakedown
