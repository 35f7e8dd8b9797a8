// SPDX-License-Identifier: MIT
// What is exported is read back by the programs that it is for (ASE, VTK, numpy), and holds the motion
// itself.
#include "export_run.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "logged_run.hpp"
#include "scratch_folder.hpp"
#include "text_frames.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

struct ReadBack {
  int status = -1;
  std::string text;
  std::vector<double> numbers;
};

/// Debian's python3 has Debian's modules; another python3 may come first on the path.
ReadBack read_back(const std::string& format, const std::filesystem::path& folder) {
  const std::string python = std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  const std::string command =
      python + " " PROJECT_ROOT "/tests/export/read_back.py " + format + " " + folder.string() + " 2>&1";
  ReadBack back;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return back;
  std::array<char, 4096> line;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) back.text += line.data();
  back.status = ::pclose(pipe) >> 8;
  std::istringstream words(back.text);
  for (double number; words >> number;) back.numbers.push_back(number);
  return back;
}

class ExportAs : public ::testing::TestWithParam<const char*> {};

std::vector<Frame> frames_of(const StoredRun& run, const FrameTimes& times) {
  std::vector<Frame> frames;
  for_each_frame(run, times, [&](const Frame& frame) { frames.push_back(frame); });
  return frames;
}

}  // namespace

TEST_P(ExportAs, IsReadBackByTheProgramItIsFor) {
  const StoredRun run = logged_run();
  const FrameTimes times{0.2, 0.3, 200};
  const ScratchFolder folder;
  const Exported exported = export_run(run, times, export_format_named(GetParam()), folder);
  EXPECT_EQ(exported.frames, 21);
  EXPECT_TRUE(std::filesystem::exists(exported.open));
  const ReadBack back = read_back(GetParam(), folder);
  if (back.status == 77 || back.status == 127)
    GTEST_SKIP() << "not read back: " << back.text << " (python3-ase, python3-vtk9, python3-numpy)";
  ASSERT_EQ(back.status, 0) << back.text;
  const Frame last = frames_of(run, times).back();
  const Vec3 &x = last.state.position[5], &v = last.state.velocity[5];
  const std::string format = GetParam();
  // ASE converts a LAMMPS dump's velocities to units of its own, so these are not compared.
  std::vector<double> expected{21, 37, last.time, x.x(), v.y(), last.state.radius[5]};
  if (format == "lammps") expected = {21, 37, x.x()};
  if (format == "xyz") expected.insert(expected.end(), {v.y(), last.state.mass[5], last.state.mass[5]});
  ASSERT_GE(back.numbers.size(), expected.size()) << back.text;
  for (std::size_t k = 0; k < expected.size(); ++k)
    WITHIN(back.numbers[k] / expected[k], 1, 1e-15, 2.3e-16) << "number " << k << " of\n" << back.text;
  if (format == "csv") return;
  WITHIN(back.numbers.back(), run.setup.box.length, 1e-16, 8.9e-18);
}

INSTANTIATE_TEST_SUITE_P(Formats, ExportAs, ::testing::Values("xyz", "lammps", "vtp", "npy", "csv"),
                         [](const auto& of) { return of.param; });

TEST(Export, FramesAreTheEnginesOwnSamples) {
  const StoredRun run = logged_run();
  shakedown::Setup setup = run.setup;
  const Trajectory trajectory = make_hard_engine()->run(setup);
  const std::vector<Frame> frames = frames_of(run, {0, 1e9, setup.run.sample_rate});
  ASSERT_EQ(frames.size(), trajectory.time.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].state.x_box, trajectory.x_box[k]);
    EXPECT_EQ(frames[k].state.v_box, trajectory.v_box[k]);
  }
}

TEST(Export, TheBoxMovesWithItsWallsAndHoldsEveryGrain) {
  const StoredRun run = logged_run();
  for (const Frame& frame : frames_of(run, {0, 1, 1000})) {
    WITHIN((frame.box_low.x() + frame.box_high.x()) / 2, frame.state.x_box, 2e-16, 2.4e-17);
    for (std::size_t i = 0; i < frame.state.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(frame.state.position[i][axis] - frame.state.radius[i], frame.box_low[axis] - 1e-12);
        EXPECT_LE(frame.state.position[i][axis] + frame.state.radius[i], frame.box_high[axis] + 1e-12);
      }
  }
}

TEST(Export, TimesOutsideTheRunAreNamed) {
  const StoredRun run = logged_run();
  EXPECT_THROW(frames_of(run, {0.6, 1, 100}), InputError);
  EXPECT_THROW(frames_of(run, {0.2, 0.1, 100}), InputError);
  EXPECT_THROW(frames_of(run, {0, 1, 0}), InputError);
  EXPECT_THROW(export_format_named("mp4"), InputError);
}

TEST(Export, TextIsExact) {
  const Frame frame = frames_of(logged_run(), {0.1, 0.1, 1}).front();
  std::istringstream lines(csv_lines(frame));
  std::string line, cell;
  std::getline(lines, line);
  std::istringstream cells(line);
  std::vector<double> numbers;
  while (std::getline(cells, cell, ',')) numbers.push_back(std::stod(cell));
  ASSERT_EQ(numbers.size(), 15u);
  EXPECT_EQ(numbers[2], frame.state.position[0].x());
  EXPECT_EQ(numbers[7], frame.state.velocity[0].z());
  EXPECT_EQ(numbers[8], frame.state.spin[0].x());
}

TEST(Export, MoreThanADiskHoldsIsRefused) {
  const StoredRun run = logged_run();
  try {
    frames_of(run, {0, 1, 1e12});
    FAIL() << "was not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--rate: gives 1.85e+13 positions"), std::string::npos)
        << error.what();
  }
}

TEST_P(ExportAs, LeavesNothingWhenItIsStopped) {
  const StoredRun run = logged_run();
  const ScratchFolder folder;
  const std::atomic<bool> stop{true};
  EXPECT_THROW(export_run(run, {0.2, 0.3, 200, &stop}, export_format_named(GetParam()), folder), Interrupted);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(Export, TakesBackItsFramesWhereTheLogDoesNotFit) {
  StoredRun run = logged_run();
  run.log.digests.back() ^= 1;
  run.file = "some.log";
  const ScratchFolder folder;
  try {
    export_run(run, {0, 1, 100}, ExportFormat::vtp, folder);
    FAIL() << "was not refused";
  } catch (const FileError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 10), "some.log: ") << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}
