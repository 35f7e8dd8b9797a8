// SPDX-License-Identifier: MIT
// Runs the shakedown program as a user would.
#pragma once
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <vector>

#include "scratch_folder.hpp"

struct Outcome {
  int code = -1;
  std::string out, err;
};

/// Runs `shakedown` with these arguments and no terminal.
Outcome shakedown_program(const std::vector<std::string>& arguments);
/// The same; what takes more than so many seconds of a core is killed (code -SIGXCPU).
Outcome shakedown_program(const std::vector<std::string>& arguments, rlim_t most_seconds);

/// The same by a user who may do nothing but read what all may read and write where all may write. Who runs
/// the tests as himself is that user already.
Outcome program_of_nobody(const std::vector<std::string>& arguments);

/// Another program of the project, by its name: it lies beside `shakedown`.
Outcome program_beside(const std::string& name, const std::vector<std::string>& arguments);

/// False where the machine has no pseudo terminals (some containers).
bool has_terminals();

/// Runs it with standard error on a terminal, sends SIGINT once `awaited` was printed there.
Outcome interrupted_program(const std::vector<std::string>& arguments, const std::string& awaited);

std::string contents(const std::filesystem::path& file);

/// An example setup of the project.
std::string example(const std::string& name);

/// A test with an empty folder of its own.
class WithFolder : public testing::Test {
 protected:
  std::string in_folder(const std::string& name) const { return (folder / name).string(); }
  /// Writes a file into the folder and returns its path.
  std::string file(const std::string& name, const std::string& text) const;
  const shakedown::ScratchFolder folder;
};
