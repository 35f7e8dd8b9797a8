// SPDX-License-Identifier: MIT
// A file of results takes nobody's place but an earlier result's, and is there whole or not at all.
#include "output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "errors.hpp"
#include "kept_files.hpp"
#include "scratch_folder.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// What is said when `file` is to be written: beforehand and at the end the same.
std::string complaint(const fs::path& file) {
  std::string before, at_the_end;
  try {
    expect_writable(file);
  } catch (const FileError& error) {
    before = error.what();
  }
  try {
    write_file(file, "new");
  } catch (const FileError& error) {
    at_the_end = error.what();
  }
  EXPECT_EQ(before, at_the_end);
  return before;
}

/// As a full disk does: no file may grow beyond so many bytes while this is alive.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace

TEST(OutputFile, TakesThePlaceOfAPlainFileAlone) {
  const ScratchFolder folder;
  write_file(folder / "precious", "old");
  fs::create_symlink(folder / "precious", folder / "link");
  fs::create_symlink(folder / "nowhere", folder / "loose");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const auto& [name, word] :
       {std::pair{"link", "link"}, {"loose", "link"}, {"pipe", "pipe"}, {"", "folder"}}) {
    const std::string said = complaint(folder / name);
    EXPECT_NE(said.find(word), std::string::npos) << said;
    EXPECT_NE(said.find("cannot be written"), std::string::npos) << said;
  }
  EXPECT_NE(complaint("").find("name"), std::string::npos);
  EXPECT_EQ(contents(folder / "precious"), "old");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
  EXPECT_EQ(complaint(folder / "precious"), "");
  EXPECT_EQ(contents(folder / "precious"), "new");
}

TEST(OutputFile, WritesThroughNoLinkThatHasTheNameOfItsNeighbour) {
  const ScratchFolder folder;
  write_file(folder / "precious", "old");
  fs::create_symlink(folder / "precious", folder / ("a.txt.partial-" + std::to_string(::getpid())));
  write_file(folder / "a.txt", "new");
  EXPECT_EQ(contents(folder / "precious"), "old");
  EXPECT_EQ(contents(folder / "a.txt"), "new");
}

TEST(OutputFile, IsThereWholeOrNotAtAll) {
  const ScratchFolder folder;
  write_file(folder / "a.txt", "old");
  {
    GrowingFile file(folder / "a.txt");
    file.add("half of ");
  }
  EXPECT_EQ(contents(folder / "a.txt"), "old");
  {
    const SmallDisk disk(1000);
    EXPECT_THROW(write_file(folder / "a.txt", std::string(3000000, 'x')), FileError);
  }
  EXPECT_EQ(contents(folder / "a.txt"), "old");
  EXPECT_EQ(entries(folder), 1u);
  GrowingFile file(folder / "a.txt");
  for (int i = 0; i < 3; ++i) file.add(std::string(1000000, 'x'));
  file.finish();
  EXPECT_EQ(fs::file_size(folder / "a.txt"), 3000000u);
}

TEST(OutputFile, ReplacesNothingThatTheCommandReads) {
  const ScratchFolder folder;
  fs::create_directories(folder / "sub");
  write_file(folder / "setup.toml", "mine");
  write_file(folder / "free.toml", "mine");
  fs::create_symlink(folder / "setup.toml", folder / "link.toml");
  keep_unchanged(folder / "free.toml");  // of no program with commands: it does not count
  begin_keeping_files();
  keep_unchanged(folder / "link.toml");
  keep_unchanged(folder / "not there yet");
  EXPECT_NE(complaint(folder / "setup.toml").find("reads it"), std::string::npos);
  EXPECT_NE(complaint(folder / "sub/../setup.toml").find("reads it"), std::string::npos);
  EXPECT_NE(complaint(folder / "not there yet").find("reads it"), std::string::npos);
  EXPECT_EQ(complaint(folder / "free.toml"), "");
  OutputFolder(folder).remove({"setup.toml", "free.toml", "sub/none"});
  EXPECT_EQ(contents(folder / "setup.toml"), "mine");
  EXPECT_FALSE(fs::exists(folder / "free.toml"));
  EXPECT_FALSE(fs::exists(folder / "sub"));
}

TEST(OutputFolder, IsUsedByOneProgramAtATime) {
  const ScratchFolder folder;
  {
    const OutputFolder first(folder, OutputFolder::Use::alone);
    const OutputFolder beside(folder);
    beside.write("a.txt", "x");
    try {
      const OutputFolder second(folder, OutputFolder::Use::alone);
      FAIL() << "two at once";
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what()).find("another program is writing"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(entries(folder), 1u);
  write_file(folder / ".being-written", "");  // of a program that was killed
  { const OutputFolder third(folder, OutputFolder::Use::alone); }
  EXPECT_EQ(entries(folder), 1u);
}
