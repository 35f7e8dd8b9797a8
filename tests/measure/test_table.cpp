// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "table.hpp"

namespace shakedown {
namespace {

Table data_table(const std::string& name) { return read_table(std::string(TEST_DATA) + "/tables/" + name); }

TEST(Table, PlainCsv) {
  const Table table = parse_table("t_s,x_box_m\n0,0.1\n0.002,\n0.004,nan\n", "t.csv");
  ASSERT_EQ(table.columns.size(), 2u);
  EXPECT_EQ(table.columns[1].name, "x_box_m");
  EXPECT_EQ(table.rows(), 3u);
  EXPECT_EQ(table.line[2], 4);
  EXPECT_TRUE(std::isnan(table.columns[1].value[1]) && std::isnan(table.columns[1].value[2]));
  EXPECT_TRUE(table.columns[1].not_numbers.empty());
}

TEST(Table, NumbersWithoutHeader) {
  const Table table = parse_table("0 0.1\n1 0.2\n2 0.3\n", "t.dat");
  EXPECT_EQ(table.header_lines, 0);
  EXPECT_EQ(table.columns[1].name, "column 2");
  EXPECT_EQ(table.columns[1].value[2], 0.3);
}

TEST(Table, WordsAndCutLinesAreReportedWithTheirPlace) {
  const Table table = parse_table("t,x\n0,0.1\n1,O.2\n2,0.3\n3\n4,inf\n5,0.1\n", "t.csv");
  ASSERT_EQ(table.columns[1].not_numbers.size(), 2u);
  EXPECT_EQ(table.columns[1].not_numbers[0].text, "O.2");
  EXPECT_EQ(table.line[table.columns[1].not_numbers[0].row], 3);
  ASSERT_EQ(table.violations.size(), 1u);
  EXPECT_EQ(table.violations[0].place.line, 5);
}

TEST(Table, WordsInTheFirstRowOfDataAreNoHeader) {
  const Table table = parse_table("t,x,y\n0,off,off\n1,off,off\n2,0.3,1\n3,0.4,1\n4,0.4,1\n", "t.csv");
  EXPECT_EQ(table.header_lines, 1);
  ASSERT_EQ(table.rows(), 5u);
  EXPECT_EQ(table.columns[1].not_numbers.size(), 2u);
}

TEST(Table, LettersOfOneByte) {
  const Table table = parse_table("Track n\xB0,Slice n\xB0,X [\xB5m]\n1,1,5\n1,2,6\n1,3,7\n", "t.csv");
  EXPECT_TRUE(table.latin);
  EXPECT_EQ(table.columns[1].name, "Slice n\xC2\xB0");
  EXPECT_EQ(table.columns[2].unit, "\xC2\xB5m");
  EXPECT_EQ(find_track_column(table), &table.columns[0]);
  EXPECT_FALSE(parse_table("Track n\xC2\xB0,X\n1,1\n", "t.csv").latin);
}

TEST(Table, NotATable) {
  EXPECT_THROW(parse_table("t," + std::string(30000, 'x') + "\n0,0.1\n1,0.2\n", "t.csv"), InputError);
  EXPECT_THROW(parse_table("", "t.csv"), InputError);
  EXPECT_THROW(parse_table("only words\nand more\n", "t.csv"), InputError);
  EXPECT_THROW(parse_table("\xFF\xFEt", "t.csv"), InputError);
  EXPECT_THROW(read_table("no/such/file.csv"), FileError);
  EXPECT_THROW(read_table(TEST_DATA), FileError);
}

TEST(Table, TrackerOneTrack) {
  const Table table = data_table("tracker_single.txt");
  EXPECT_EQ(table.delimiter, '\t');
  EXPECT_EQ(column_names(table), (std::vector<std::string>{"t", "x", "y"}));
  EXPECT_EQ(table.rows(), 8u);
  EXPECT_DOUBLE_EQ(table.columns[1].value[0], 0.1075);
  EXPECT_TRUE(std::isnan(table.columns[1].value[3]));
  EXPECT_TRUE(table.violations.empty());
}

TEST(Table, TrackerTracksSideBySide) {
  const Table table = data_table("tracker_multi.csv");
  EXPECT_EQ(column_names(table), (std::vector<std::string>{"t", "box.x", "box.y", "grains.x", "grains.y"}));
  EXPECT_DOUBLE_EQ(find_column(table, "grains.x")->value[0], 0.1185);
  EXPECT_TRUE(std::isnan(find_column(table, "grains.x")->value[5]));
  EXPECT_TRUE(table.violations.empty());
}

TEST(Table, TrackMateHasFourHeaderRows) {
  const Table table = data_table("trackmate_spots.csv");
  EXPECT_EQ(table.header_lines, 4);
  ASSERT_NE(find_column(table, "POSITION_X"), nullptr);
  EXPECT_EQ(find_column(table, "POSITION_X")->unit, "micron");
  EXPECT_EQ(find_column(table, "POSITION_T")->unit, "sec");
  EXPECT_EQ(table.rows(), 17u);
}

TEST(Table, TrackpyAndImageJ) {
  EXPECT_EQ(find_column(data_table("trackpy.csv"), "particle")->value[1], 3);
  const Table table = data_table("imagej_manual.txt");
  ASSERT_NE(find_column(table, "X"), nullptr);
  EXPECT_EQ(find_column(table, "Slice n")->value[5], 6);
}

TEST(Table, SpreadsheetWithDecimalCommaAndByteOrderMark) {
  const Table table = data_table("spreadsheet.csv");
  EXPECT_EQ(table.delimiter, ';');
  EXPECT_TRUE(table.decimal_comma);
  ASSERT_NE(find_column(table, "Zeit"), nullptr);
  EXPECT_EQ(find_column(table, "Zeit")->unit, "ms");
  EXPECT_NE(find_column(table, "x [mm]"), nullptr);
  EXPECT_DOUBLE_EQ(find_column(table, "x")->value[0], 107.5);
}

TEST(Table, HeaderInAComment) {
  const Table table = data_table("logger.dat");
  EXPECT_EQ(column_names(table), (std::vector<std::string>{"t_s", "x_box_mm"}));
  EXPECT_EQ(table.rows(), 6u);
}

}  // namespace
}  // namespace shakedown
