// SPDX-License-Identifier: MIT
// Runs programs of other people without a shell between.
#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace shakedown {

struct ChildProgram {
  std::vector<std::string> words;           ///< the program (a path, or a name on the PATH) and its arguments
  std::vector<std::string> environment;     ///< "NAME=value", beside our own
  std::filesystem::path folder;             ///< in which it works; empty: ours
  std::filesystem::path output, error;      ///< files that take its standard output and standard error
  std::function<void()> now_and_then;       ///< called some times a second while it works; may be empty
  const std::atomic<bool>* stop = nullptr;  ///< set to true to end it
};

struct ChildEnd {
  int exit_code = 0;     ///< where it ended by itself
  int signal = 0;        ///< that ended it; 0: none
  bool stopped = false;  ///< on request
};

/// Runs the program to its end. It has a process group of its own, which is ended (SIGTERM, two seconds later
/// SIGKILL) on request and when `now_and_then` throws; no descriptor of ours is open in it. Throws InputError
/// when it cannot be started. Thread-safe.
ChildEnd run_child(const ChildProgram& program);

/// Returns the file that this name stands for on the PATH (or the path itself); nothing when there is no
/// program.
std::optional<std::filesystem::path> program_named(const std::string& name);

/// Returns "ended with exit code 1", "was ended by signal 11 (Segmentation fault)".
std::string in_words(const ChildEnd& end);

}  // namespace shakedown
