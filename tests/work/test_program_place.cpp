// SPDX-License-Identifier: MIT
#include "program_place.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "scratch_folder.hpp"

using namespace shakedown;

namespace {

namespace fs = std::filesystem;

void install(const fs::path& program, bool executable = true) {
  fs::create_directories(program.parent_path());
  std::ofstream(program) << "#!/bin/sh\n";
  fs::permissions(program, executable ? fs::perms::owner_all : fs::perms::owner_read);
}

}  // namespace

TEST(ProgramPlace, AFasterProgramIsTheOneOfTheSameNameBelowLibexec) {
  const ScratchFolder prefix;
  const fs::path program = prefix / "bin/shakedown",
                 faster = prefix / "libexec/shakedown/x86-64-v3/shakedown";
  install(program);
  EXPECT_EQ(faster_program(program), "");
  install(faster);
  EXPECT_EQ(faster_program(program), faster);
  EXPECT_EQ(faster_program(prefix / "bin/shakedown-studies"), "");
  EXPECT_EQ(faster_program(faster), "");  // it is the one already
}

TEST(ProgramPlace, AFileThatCannotBeRunIsNone) {
  const ScratchFolder prefix;
  install(prefix / "libexec/shakedown/x86-64-v3/shakedown", false);
  EXPECT_EQ(faster_program(prefix / "bin/shakedown"), "");
}

TEST(ProgramPlace, BothFindWhatLiesBesideTheProgramsOfTheirPrefix) {
  EXPECT_EQ(program_folder("/usr/libexec/shakedown/x86-64-v3/shakedown"), "/usr/bin");
  EXPECT_EQ(program_folder("/usr/bin/shakedown"), "/usr/bin");
  EXPECT_EQ(program_folder("/home/me/build/release/shakedown"), "/home/me/build/release");
  EXPECT_EQ(program_folder("/shakedown"), "/");
}

TEST(ProgramPlace, ThisBuildRunsHere) {
#if defined(__AVX2__) && defined(__FMA__)
  EXPECT_TRUE(has_faster_level());
#endif
  EXPECT_TRUE(fs::is_directory(program_folder()));
}
