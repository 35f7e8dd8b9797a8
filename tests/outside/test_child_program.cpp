// SPDX-License-Identifier: MIT
#include "child_program.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "errors.hpp"
#include "outside_errors.hpp"
#include "scratch_folder.hpp"
#include "work_folder.hpp"

using namespace shakedown;

namespace {

class AChild : public testing::Test {
 protected:
  ChildProgram shell(const std::string& line) const {
    ChildProgram program;
    program.words = {"sh", "-c", line};
    program.output = folder / "out";
    program.error = folder / "err";
    return program;
  }
  const ScratchFolder folder;
};

TEST_F(AChild, SaysHowItEnded) {
  EXPECT_EQ(run_child(shell("exit 0")).exit_code, 0);
  EXPECT_EQ(in_words(run_child(shell("exit 7"))), "ended with exit code 7");
  EXPECT_EQ(run_child(shell("kill -9 $$")).signal, 9);
}

TEST_F(AChild, WritesIntoFilesAndReadsNothing) {
  ChildProgram program = shell("pwd; echo $WORD; cat; echo oh >&2");
  program.environment = {"WORD=said"};
  program.folder = folder.path();
  run_child(program);
  EXPECT_EQ(contents_of(folder / "out"), std::filesystem::canonical(folder.path()).string() + "\nsaid\n");
  EXPECT_EQ(contents_of(folder / "err"), "oh\n");
}

TEST_F(AChild, HasNoFileOfOursOpen) {
  const std::ofstream ours(folder / "ours");
  run_child(shell("ls /proc/self/fd | wc -l"));
  EXPECT_LE(std::stoi(contents_of(folder / "out")), 4);  // 0, 1, 2 and the folder that ls reads
}

TEST_F(AChild, EndsOnRequestWithItsOwnChildren) {
  const std::atomic<bool> stop = true;
  ChildProgram program = shell("(sleep 0.5; touch late) & sleep 100");
  program.folder = folder.path();
  program.stop = &stop;
  const auto started = std::chrono::steady_clock::now();
  EXPECT_TRUE(run_child(program).stopped);
  EXPECT_LT(std::chrono::steady_clock::now() - started, std::chrono::seconds(2));
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  EXPECT_FALSE(std::filesystem::exists(folder / "late"));
}

TEST_F(AChild, EndsWhenTheCallerThrows) {
  ChildProgram program = shell("sleep 100");
  program.now_and_then = [] { throw PhysicsError("enough"); };
  EXPECT_THROW(run_child(program), PhysicsError);
}

TEST_F(AChild, ThatDoesNotExistIsAnErrorOfInput) {
  ChildProgram program = shell("");
  program.words = {(folder / "none").string()};
  EXPECT_THROW(run_child(program), InputError);
}

TEST(ProgramNamed, IsFoundOnThePath) {
  EXPECT_TRUE(program_named("sh"));
  EXPECT_FALSE(program_named("no_such_program_at_all"));
  EXPECT_FALSE(program_named(""));
  EXPECT_FALSE(program_named("/tmp"));
}

TEST(WorkFolder, IsGoneUnlessItIsKept) {
  std::filesystem::path gone;
  {
    const WorkFolder folder("");
    folder.write("a", "text");
    gone = folder.path();
    EXPECT_EQ(contents_of(folder / "a"), "text");
  }
  EXPECT_FALSE(std::filesystem::exists(gone));
  const ScratchFolder scratch;
  { const WorkFolder folder(scratch / "kept"); }
  EXPECT_TRUE(std::filesystem::exists(scratch / "kept"));
}

TEST(WorkFolder, ThatIsKeptWritesThroughNoLink) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "kept");
  std::ofstream(scratch / "precious") << "mine";
  std::filesystem::create_symlink("../precious", scratch / "kept" / "setup.json");
  const WorkFolder folder(scratch / "kept");
  EXPECT_THROW(folder.write("setup.json", "{}"), FileError);
  EXPECT_EQ(contents_of(scratch / "precious"), "mine");
  EXPECT_THROW(folder.make_way("setup.json"), FileError);
  folder.write("motion.csv", "of an earlier run");
  folder.make_way("motion.csv");
  EXPECT_FALSE(std::filesystem::exists(folder / "motion.csv"));
  folder.write("in.lammps", "run 0");
  EXPECT_EQ(contents_of(folder / "in.lammps"), "run 0");
}

TEST(KeptFolder, IsThatOfTheOptionBeforeThatOfTheEnvironment) {
  const Named named("SHAKEDOWN_KEEP", "/somewhere");
  EXPECT_EQ(kept_folder("lammps", 3), "/somewhere/lammps/run_3");
  keep_outside_files("/elsewhere");
  EXPECT_EQ(kept_folder("lammps", 3), "/elsewhere/lammps/run_3");
  keep_outside_files("");
  const Named unnamed("SHAKEDOWN_KEEP", "");
  EXPECT_EQ(kept_folder("lammps", 3), "");
}

TEST(KeptFolder, IsNotGivenTwice) {
  const Named named("SHAKEDOWN_KEEP", "/a_folder");
  EXPECT_EQ(kept_folder("damper.py", 0), "/a_folder/damper.py/run_0");
  EXPECT_EQ(kept_folder("damper.py", 1), "/a_folder/damper.py/run_1");
  EXPECT_EQ(kept_folder("damper.py", 0), "/a_folder/damper.py/run_0_2");
  EXPECT_EQ(kept_folder("damper.py", 0), "/a_folder/damper.py/run_0_3");
}

}  // namespace
