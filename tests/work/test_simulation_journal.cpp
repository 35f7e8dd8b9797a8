// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "errors.hpp"
#include "scratch_folder.hpp"
#include "simulation_journal.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

class Journal : public ::testing::Test {
 protected:
  using Features = SimulationJournal::Features;
  SimulationJournal opened(bool resume, const std::string& work = "these measurements") const {
    return {file, work, resume};
  }

  ScratchFolder folder;
  fs::path file = folder / "simulations.journal";
  const Features two{Eigen::Vector3d(1, -2.5, 1e-300), Eigen::Vector2d(0.1, 3)}, one{Eigen::Vector2d(7, 8)};
};

TEST_F(Journal, GivesBackBitForBitWhatWasKeptAfterAnInterruption) {
  {
    SimulationJournal journal = opened(true);  // nothing there yet
    EXPECT_FALSE(journal.find("a"));
    journal.keep("a", two);
    journal.keep("b", one);
    EXPECT_EQ(journal.find("a"), two);
  }
  {
    SimulationJournal journal = opened(true);
    EXPECT_EQ(journal.kept(), 2);
    EXPECT_EQ(journal.find("a"), two);
    EXPECT_EQ(journal.find("b"), one);
    EXPECT_FALSE(journal.find("c"));
    journal.keep("c", {});
  }
  EXPECT_EQ(opened(true).kept(), 3);
}

TEST_F(Journal, BeginsAfreshWithoutResume) {
  opened(false).keep("a", one);
  EXPECT_EQ(opened(false).kept(), 0);
  EXPECT_EQ(SimulationJournal(file.string() + ".old", "these measurements", true).find("a"), one);
  EXPECT_EQ(opened(true).kept(), 0);
}

TEST_F(Journal, GoesOnBehindTheLastWholeRecord) {
  {
    SimulationJournal journal = opened(false);
    journal.keep("a", two);
    journal.keep("b", one);
  }
  const std::uintmax_t whole = fs::file_size(file);
  const std::uintmax_t last = 8 * (2 + 1 + 2 + 1);  // key, count; size; numbers; sum
  for (const std::uintmax_t cut : {std::uintmax_t{1}, std::uintmax_t{8}, last - 1, last}) {
    const fs::path kept = folder / "kept";
    fs::copy_file(file, kept, fs::copy_options::overwrite_existing);
    fs::resize_file(file, whole - cut);
    {
      SimulationJournal journal = opened(true);
      EXPECT_EQ(journal.kept(), 1) << cut;
      EXPECT_EQ(journal.find("a"), two);
      journal.keep("b", one);
    }
    EXPECT_EQ(opened(true).find("b"), one) << cut;
    fs::rename(kept, file);
  }
  std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
  damaged.seekp(static_cast<std::streamoff>(whole - last + 24));  // a number of the last record
  damaged.put('!');
  damaged.close();
  EXPECT_EQ(opened(true).kept(), 1);
}

TEST_F(Journal, OfOtherWorkIsRefusedAndLeftAlone) {
  opened(false).keep("a", one);
  try {
    opened(true, "other measurements");
    FAIL() << "taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--resume"), std::string::npos) << error.what();
  }
  EXPECT_EQ(opened(true).kept(), 1);
}

TEST_F(Journal, ThatCannotBeWrittenIsAFileError) {
  std::ofstream(folder / "plain") << "no folder";
  file = folder / "plain" / "simulations.journal";
  EXPECT_THROW(opened(false), FileError);
  fs::create_symlink("nowhere", folder / "link");
  file = folder / "link";
  EXPECT_THROW(opened(false), FileError);
}

}  // namespace
