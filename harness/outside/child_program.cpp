// SPDX-License-Identifier: MIT
#include "child_program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "errors.hpp"

extern char** environ;

namespace shakedown {

namespace {

using namespace std::chrono_literals;

/// What posix_spawn is to do, freed at the end.
class SpawnPlan {
 public:
  explicit SpawnPlan(const ChildProgram& program) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawnattr_init(&attributes_);
    if (!program.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, program.folder.c_str());
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, program.output.c_str(), flags, 0644);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, program.error.c_str(), flags, 0644);
    posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
    // The program begins without our own handlers and masks.
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  const posix_spawn_file_actions_t* actions() const { return &actions_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// Returns the words as execve wants them, with a null at the end.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::vector<std::string> environment_with(const std::vector<std::string>& more) {
  std::vector<std::string> all = more;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view line = *entry;
    const std::string_view name = line.substr(0, line.find('=') + 1);
    if (std::ranges::none_of(more, [&](const std::string& ours) { return ours.starts_with(name); }))
      all.emplace_back(line);
  }
  return all;
}

pid_t started(const ChildProgram& program) {
  const SpawnPlan plan(program);
  std::vector<std::string> words = program.words, environment = environment_with(program.environment);
  pid_t child = 0;
  const int problem = ::posix_spawnp(&child, words[0].c_str(), plan.actions(), plan.attributes(),
                                     pointers_to(words).data(), pointers_to(environment).data());
  if (problem != 0)
    throw InputError(
        {{{},
          program.words[0],
          std::string("the program cannot be started (") + std::strerror(problem) + ")",
          "check that it exists, may be executed (chmod +x) and that a script's first line names "
          "its interpreter"}});
  return child;
}

/// A child that runs; what is left of its group is ended when this goes out of scope.
class RunningChild {
 public:
  explicit RunningChild(pid_t id) : id_(id) {}
  ~RunningChild() {
    if (!ended_) end();
  }
  RunningChild(const RunningChild&) = delete;
  RunningChild& operator=(const RunningChild&) = delete;

  /// Tells whether it has ended by itself.
  bool has_ended() {
    pid_t answer = 0;
    do answer = ::waitpid(id_, &status_, WNOHANG);
    while (answer < 0 && errno == EINTR);
    return ended_ = answer != 0;
  }
  void end() {
    ::kill(-id_, SIGTERM);
    const auto patience = std::chrono::steady_clock::now() + 2s;
    while (!has_ended() && std::chrono::steady_clock::now() < patience) std::this_thread::sleep_for(5ms);
    ::kill(-id_, SIGKILL);  // children of its own too, which may outlive it
    if (!ended_) ::waitpid(id_, &status_, 0);
    ended_ = true;
  }
  ChildEnd how() const {
    if (WIFSIGNALED(status_)) return {0, WTERMSIG(status_), false};
    return {WEXITSTATUS(status_), 0, false};
  }

 private:
  pid_t id_;
  int status_ = 0;
  bool ended_ = false;
};

bool is_program(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
}

}  // namespace

ChildEnd run_child(const ChildProgram& program) {
  EXPECT(!program.words.empty());
  RunningChild child(started(program));
  auto pause = 1ms;
  auto told = std::chrono::steady_clock::now();
  while (!child.has_ended()) {
    if (program.stop != nullptr && program.stop->load(std::memory_order_relaxed)) {
      child.end();
      return {0, 0, true};
    }
    if (program.now_and_then && std::chrono::steady_clock::now() - told > 300ms) {
      program.now_and_then();
      told = std::chrono::steady_clock::now();
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::milliseconds(20));
  }
  return child.how();
}

std::optional<std::filesystem::path> program_named(const std::string& name) {
  if (name.find('/') != std::string::npos)
    return is_program(name) ? std::optional<std::filesystem::path>(name) : std::nullopt;
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "/usr/bin:/bin" : path;
  while (!name.empty()) {
    const std::size_t colon = rest.find(':');
    const std::filesystem::path file = std::filesystem::path(rest.substr(0, colon)) / name;
    if (is_program(file)) return file;
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  return std::nullopt;
}

std::string in_words(const ChildEnd& end) {
  if (end.stopped) return "was stopped";
  if (end.signal != 0)
    return "was ended by signal " + std::to_string(end.signal) + " (" + ::strsignal(end.signal) + ")";
  return "ended with exit code " + std::to_string(end.exit_code);
}

}  // namespace shakedown
