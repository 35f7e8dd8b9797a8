// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>

#include "experiment_file.hpp"
#include "import_tables.hpp"
#include "scratch_folder.hpp"

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
  EXPECT_EQ(length("run7.csv"), "\"? mm\"");
}

TEST(ImportTables, AsksForWhatNobodyCanGuess) {
  const ImportedTables tables = imported("trackpy.csv");
  ASSERT_EQ(tables.open_questions.size(), 4u);  // pixel size (twice), frame rate, box length
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
