// SPDX-License-Identifier: MIT
// Angles, frames counted from anywhere, films with a lead-in, and files that are no tables.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "experiment_file.hpp"
#include "import_tables.hpp"
#include "measurement.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

namespace shakedown {
namespace {

class TablesAsTheyCome : public ::testing::Test {
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
  void expect_message(const std::string& text, const std::vector<std::string>& parts) {
    const std::string message = message_of(text);
    for (const std::string& part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
  }
  ImportedTables imported(const std::string& name) { return import_tables({folder_ / name}, folder_.path()); }

  const ScratchFolder folder_;
  const std::string run_ = "[[run]]\nfile = \"a.csv\"\n";
};

TEST_F(TablesAsTheyCome, AnglesBecomeLengths) {
  write("a.csv", "t_s,angle\n0,183\n0.1,182\n0.2,180\n0.3,178\n0.4,177\n");
  const std::string columns =
      "[column.time]\nfrom = \"t_s\"\nunit = \"s\"\n[column.box_position]\nfrom = \"angle\"\nunit = "
      "\"deg\"\n";
  const Experiment stated =
      parse(columns +
            "per_radian = \"100 mm\"\norigin = \"3.14159265358979 rad\"\nuncertainty = \"0.1 deg\"\n" + run_);
  const double degree = std::acos(-1.0) / 180;
  WITHIN(stated.runs[0].x_box[0], 3 * degree * 0.1, 5e-15, 2.9e-16);
  WITHIN(stated.runs[0].box_uncertainty, 0.1 * degree * 0.1, 7e-19, 3.9e-20);
  EXPECT_TRUE(stated.runs[0].origin_stated);
  const Experiment open = parse(columns + "per_radian = \"100 mm\"\n" + run_);
  WITHIN(open.runs[0].x_box[0], 183 * degree * 0.1, 1e-15, 7.1e-17);
  EXPECT_FALSE(open.runs[0].origin_stated);
  EXPECT_NE(digest(stated), digest(open));
  expect_message(columns + run_, {"'deg' cannot be turned into metres", "per_radian"});
  expect_message(columns + "per_radian = \"100 mm\"\norigin = \"3 mm\"\n" + run_, {"is no angle", "rad"});
  expect_message(columns + "per_radian = \"100 g\"\n" + run_, {"a length"});
}

TEST_F(TablesAsTheyCome, FramesCountFromTheFirstUnlessTheReleaseIsStated) {
  write("a.csv", "slice,x\n1,107\n2,106\n3,104\n4,101\n5,97\n6,92\n7,86\n");
  const std::string columns =
      "[camera]\nframe_rate = \"10 Hz\"\n[column.time]\nfrom = \"slice\"\nunit = "
      "\"frame\"\n[column.box_position]\nfrom = \"x\"\nunit = \"mm\"\n";
  const Experiment experiment = parse(columns + run_);
  EXPECT_DOUBLE_EQ(experiment.runs[0].time[0], 0);
  ASSERT_EQ(experiment.notes.size(), 1u);
  EXPECT_NE(experiment.notes[0].find("counted from 1"), std::string::npos) << experiment.notes[0];
  const Experiment stated = parse(columns + run_ + "release_time = \"0.2 s\"\n");
  EXPECT_EQ(stated.runs[0].time[0], 0);  // slice 2
  EXPECT_DOUBLE_EQ(stated.runs[0].x_box[0], 0.106);
}

TEST_F(TablesAsTheyCome, WhatComesBeforeTheReleaseIsNoMotion) {
  write("a.csv",
        "t,x,c\n0,107,118\n0.1,107,118\n0.2,107,118\n0.3,106,117\n0.4,104,115\n0.5,101,112\n0.6,97,108\n");
  const std::string columns =
      "[column.time]\nfrom = \"t\"\nunit = \"s\"\n[column.box_position]\nfrom = \"x\"\nunit = \"mm\"\n"
      "[column.grain_centre]\nfrom = \"c\"\nunit = \"mm\"\n";
  const MeasuredRun run = parse(columns + run_ + "release_time = \"0.2 s\"\n").runs[0];
  EXPECT_EQ(run.time.size(), 5u);
  EXPECT_EQ(run.x_box.size(), 5u);
  EXPECT_EQ(run.x_com.size(), 5u);
  EXPECT_EQ(run.time[0], 0);
  EXPECT_EQ(run.lead_in.time.size(), 2u);
  EXPECT_EQ(run.lead_in.x_com.size(), 2u);
  expect_message(columns + run_ + "release_time = \"7 s\"\n", {"after the end of the recording"});
  EXPECT_TRUE(parse(columns + run_).runs[0].lead_in.time.empty());
}

TEST_F(TablesAsTheyCome, OneMessageForManyAlikeCells) {
  std::string text = "t,x\n";
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + "," + (i % 2 ? "lost" : "3") + "\n";
  write("a.csv", text);
  const std::string columns =
      "[column.time]\nfrom = \"t\"\nunit = \"s\"\n[column.box_position]\nfrom = \"x\"\nunit = \"mm\"\n";
  const std::string message = message_of(columns + run_);
  EXPECT_NE(message.find("'lost' is not a number (in 50 cells, here the first)"), std::string::npos)
      << message;
  EXPECT_EQ(message.find("a.csv:5"), std::string::npos) << message;
  write("a.csv", "t;x\n0;1,5\n1;#NV\n2;1,4\n3;1,2\n4;0,9\n5;#NV\n");
  EXPECT_TRUE(std::isnan(parse(columns + run_).runs[0].x_box[1]));
}

TEST_F(TablesAsTheyCome, AbsurdValuesAreRefused) {
  write("a.csv", "t,x\n0,107\n0.1,107\n0.2,107\n0.3,106\n0.4,104\n");
  const std::string columns =
      "[column.time]\nfrom = \"t\"\nunit = \"s\"\n[column.box_position]\nfrom = \"x\"\nunit = \"mm\"\n";
  expect_message(columns + run_ + "box_length = \"1e308 mm\"\n", {"run.box_length", "between"});
  for (const char* value : {"inf", "nan"}) {
    const Experiment experiment = parse(columns + run_ + "grains.count = " + value + "\n");
    EXPECT_THROW(setup_of_run({}, experiment.runs[0], {}), InputError) << value;
  }
}

TEST_F(TablesAsTheyCome, OtherFilesSayWhatToDo) {
  expect_message("t,x\n0,107\n0.1,106\n0.2,105\n", {"is a table", "shakedown import experiment.toml"});
  expect_message("[box]\nmass = \"434 g\"\n", {"is a setup"});
  expect_message("title = \n", {"experiment.toml:1"});
  const auto refused = [&](const std::string& bytes, const std::string& part) {
    write("a.bin", bytes);
    try {
      imported("a.bin");
      FAIL();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused("MATLAB 5.0 MAT-file, Platform", "writetable");
  refused("\x89HDF\r\n", "writetable");
  refused("PK\x03\x04...", "save it as CSV");
  refused(std::string("\0\0\0\x20"
                      "ftypisom",
                      12),
          "is a film");
  refused("RIFF....AVI ", "is a film");
}

std::string rows(int columns) {
  std::string text;
  for (int i = 0; i < 20; ++i) {
    text += std::to_string(i * 0.05);
    for (int j = 1; j < columns; ++j) text += "," + std::to_string(std::cos(i * 0.3 + 0.1 * j));
    text += "\n";
  }
  return text;
}

TEST_F(TablesAsTheyCome, ImportKnowsOtherNames) {
  const auto box = [&](const std::string& header) {
    write("a.csv", header + "\n" + rows(2));
    const ImportedTables tables = imported("a.csv");
    return tables.columns[0].from + "|" + tables.columns[0].unit + " " + tables.columns[1].from + "|" +
           tables.columns[1].unit;
  };
  EXPECT_EQ(box("Zeit [s],Weg [cm]"), "Zeit|s Weg|cm");
  EXPECT_EQ(box("t_s,angle_rad"), "t_s|s angle_rad|rad");
  EXPECT_EQ(box("t_s,Winkel [\u00b0]"), "t_s|s Winkel|\u00b0");
  EXPECT_EQ(box("Time (s),Position (m)"), "Time|s Position|m");
  EXPECT_EQ(box("t [s],x(t)"), "t|s x(t)|mm");
  EXPECT_EQ(box("t [s],theta"), "t|s theta|rad");
  EXPECT_EQ(box("t [s],phi(t) [rad]"), "t|s phi(t)|rad");
  EXPECT_EQ(box("t [s],Auslenkung_mm"), "t|s Auslenkung_mm|mm");
  write("b.csv", "Bild;x_mm\n1;107\n2;106\n3;104\n4;101\n");
  EXPECT_EQ(imported("b.csv").columns[0].unit, "frame");
}

TEST_F(TablesAsTheyCome, TrialsSideBySideAreRunsOfTheirOwn) {
  write("data.csv", "1 Time,1 Position,2 Position,7: Position\n" + rows(4));
  const ImportedTables tables = imported("data.csv");
  for (const char* part : {"from = \"1 Time\"", "column.box_position.from = \"2 Position\"",
                           "column.box_position.from = \"7: Position\""})
    EXPECT_NE(tables.experiment.find(part), std::string::npos) << tables.experiment;
  EXPECT_NE(tables.preview.find("3 columns are named like '1 Position': one run each"), std::string::npos);
}

TEST_F(TablesAsTheyCome, TwoTracksAreNotMixedInThePreview) {
  std::string text = "frame,particle,x\n";
  for (int i = 0; i < 10; ++i)
    text += std::to_string(i) + ",0," + std::to_string(900 - i) + "\n" + std::to_string(i) + ",1," +
            std::to_string(500 - i) + "\n";
  write("a.csv", text);
  const std::string preview = imported("a.csv").preview;
  EXPECT_NE(preview.find("900 899 898 ... 891"), std::string::npos) << preview;
  EXPECT_NE(preview.find("500 499 498 ... 491"), std::string::npos) << preview;
}

}  // namespace
}  // namespace shakedown
