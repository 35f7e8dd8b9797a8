// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "closed_form_engine.hpp"
#include "output_file.hpp"
#include "run_results.hpp"
#include "scratch_folder.hpp"
#include "series_file.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

class Files : public testing::Test {
 protected:
  static std::string contents(const fs::path& file) {
    std::ifstream stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
  }

  const ScratchFolder folder;
};

Trajectory two_samples() {
  Trajectory trajectory;
  trajectory.time = {0, 0.002};
  trajectory.x_box = {0.1075, 1.0 / 3};
  trajectory.v_box = {0, -0.01};
  trajectory.x_com = {0.11, std::nan("")};
  trajectory.total_energy = {0.15, 0.14};
  for (auto& loss : trajectory.loss) loss = {0, 1e-5};
  return trajectory;
}

}  // namespace

TEST_F(Files, AreReplacedWholeAndLeaveNothingBeside) {
  write_file(folder / "deep" / "a.txt", "first");
  write_file(folder / "deep" / "a.txt", "second");
  EXPECT_EQ(contents(folder / "deep" / "a.txt"), "second");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "deep"), fs::directory_iterator()), 1);
}

TEST_F(Files, SayBeforehandThatTheyCannotBeWritten) {
  write_file(folder / "plain", "x");
  EXPECT_THROW(expect_writable(folder / "plain" / "below.json"), FileError);
  EXPECT_THROW(expect_writable(folder), FileError);
  EXPECT_THROW(OutputFolder(folder / "plain"), FileError);
  EXPECT_THROW(write_file(folder / "plain" / "below.json", "x"), FileError);
  expect_writable(folder / "new.json");
  EXPECT_EQ(entries(), 1u);  // the trial left nothing
  try {
    expect_writable(folder / "plain" / "below.json");
  } catch (const FileError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be written"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("choose another place"), std::string::npos);
  }
}

TEST(SeriesFile, TenDigitsAndEmptyCells) {
  EXPECT_EQ(
      series_csv(two_samples()),
      "t_s,x_box_m,v_box_m_per_s,x_com_m,total_energy_J,loss_grain_grain_J,loss_end_wall_J,loss_side_wall_J\n"
      "0,0.1075,0,0.11,0.15,0,0,0\n"
      "0.002,0.3333333333,-0.01,,0.14,1e-05,1e-05,1e-05\n");
}

TEST(SeriesFile, MeanAndSpreadOfTheMotion) {
  MeanSeries mean;
  Trajectory other = two_samples();
  mean.add(other);
  other.x_box = {0.1085, 1.0 / 3 + 0.002};
  mean.add(other);
  std::istringstream lines(mean.csv());
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  EXPECT_EQ(line, "0,0.108,0.0007071067812,0.11,0,0.15,0");
  std::getline(lines, line);
  EXPECT_EQ(line, "0.002,0.3343333333,0.001414213562,,,0.14,0");
}

TEST_F(Files, ResultsOfAnEnsemble) {
  const ClosedFormEngine engine;
  shakedown::Setup setup;
  setup.run.duration = 3;
  setup.run.sample_rate = 50;
  RunResults results(OutputFolder(folder), true);
  EnsembleOptions options;
  options.runs = 3;
  options.execution.threads = 2;
  options.each = [&](int run, const Trajectory& trajectory, const Observables& seen) {
    results.add(run, trajectory, seen);
  };
  const Ensemble ensemble = run_ensemble(engine, setup, options);
  results.finish(ensemble, setup, provenance_of_this_program());
  for (const char* name : {"series.csv", "mean_series.csv", "runs.csv", "summary.json", "provenance.json",
                           "setup.toml", "series/run_0000.csv", "series/run_0002.csv"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
  EXPECT_EQ(contents(folder / "series.csv"), contents(folder / "series" / "run_0000.csv"));
  EXPECT_EQ(entries(), 7u);
}

TEST_F(Files, NothingOfAnEarlierRunStaysBesideTheResults) {
  const ClosedFormEngine engine;
  shakedown::Setup setup;
  setup.run.duration = 1;
  setup.run.sample_rate = 50;
  const auto write = [&](int count, bool every_series) {
    RunResults results(OutputFolder(folder), every_series);
    EnsembleOptions options;
    options.runs = count;
    options.each = [&](int run, const Trajectory& trajectory, const Observables& seen) {
      results.add(run, trajectory, seen);
    };
    results.finish(run_ensemble(engine, setup, options), setup, provenance_of_this_program());
  };
  write(3, true);
  write_file(folder / "collisions.log", "of the first");
  write_file(folder / "collisions" / "run_0002.log", "of the first");
  write_file(folder / "series" / "mine.csv", "not of a run");
  write(1, false);
  for (const char* gone :
       {"collisions.log", "collisions", "runs.csv", "mean_series.csv", "series/run_0000.csv"})
    EXPECT_FALSE(fs::exists(folder / gone)) << gone;
  EXPECT_EQ(contents(folder / "series" / "mine.csv"), "not of a run");
  for (const char* name : {"series.csv", "summary.json", "provenance.json", "setup.toml"})
    EXPECT_TRUE(fs::exists(folder / name)) << name;
}
