// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "experiment_file.hpp"
#include "import_tables.hpp"

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
  EXPECT_EQ(summary(imported("imagej_manual.txt")), "Slice n|frame; X|px; |; ");
  EXPECT_EQ(summary(imported("spreadsheet.csv")), "Zeit|ms; x|mm; Schwerpunkt|mm; ");
  EXPECT_EQ(summary(imported("logger.dat")), "t_s|s; x_box_mm|mm; |; ");
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
