// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <fcntl.h>
#include <grp.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <sstream>

namespace fs = std::filesystem;

namespace {

struct Captured {
  shakedown::ScratchFolder folder;
  fs::path path = folder / "stream";
  int descriptor = ::open(path.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  Captured() = default;
  ~Captured() { ::close(descriptor); }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
};

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execv(program.c_str(), words.data());
  ::_exit(127);
}

int exit_code_of(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

constexpr uid_t nobody = 65534;

/// Gives up what root may do.
void become_nobody() {
  if (::geteuid() != 0) return;
  if (::setgroups(0, nullptr) != 0 || ::setgid(nobody) != 0 || ::setuid(nobody) != 0) ::_exit(126);
}

Outcome outcome_of(const std::string& program, const std::vector<std::string>& arguments, rlim_t most_seconds,
                   bool as_nobody = false) {
  const Captured out, err;
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    ::dup2(out.descriptor, STDOUT_FILENO);
    ::dup2(err.descriptor, STDERR_FILENO);
    const rlimit limit{most_seconds, most_seconds};
    ::setrlimit(RLIMIT_CPU, &limit);
    if (as_nobody) become_nobody();
    become(program, arguments);
  }
  const int code = exit_code_of(child);
  return {code, contents(out.path), contents(err.path)};
}

}  // namespace

Outcome shakedown_program(const std::vector<std::string>& arguments) {
  return shakedown_program(arguments, RLIM_INFINITY);
}

Outcome shakedown_program(const std::vector<std::string>& arguments, rlim_t most_seconds) {
  return outcome_of(SHAKEDOWN, arguments, most_seconds);
}

Outcome program_of_nobody(const std::vector<std::string>& arguments) {
  return outcome_of(SHAKEDOWN, arguments, RLIM_INFINITY, true);
}

Outcome program_beside(const std::string& name, const std::vector<std::string>& arguments) {
  return outcome_of((fs::path(SHAKEDOWN).parent_path() / name).string(), arguments, RLIM_INFINITY);
}

Outcome interrupted_program(const std::vector<std::string>& arguments, const std::string& awaited) {
  const Captured out;
  int terminal = -1, far_end = -1;
  EXPECT_EQ(::openpty(&terminal, &far_end, nullptr, nullptr, nullptr), 0);
  if (terminal < 0) return {};
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(out.descriptor, STDOUT_FILENO);
    ::dup2(far_end, STDERR_FILENO);
    ::close(terminal);
    become(SHAKEDOWN, arguments);
  }
  ::close(far_end);
  std::string seen;
  bool sent = false;
  std::array<char, 512> part;
  for (ssize_t count; (count = ::read(terminal, part.data(), part.size())) > 0;) {
    seen.append(part.data(), static_cast<std::size_t>(count));
    if (!sent && seen.find(awaited) != std::string::npos) {
      ::kill(child, SIGINT);
      sent = true;
    }
  }
  ::close(terminal);
  const int code = exit_code_of(child);
  EXPECT_TRUE(sent) << seen;
  return {code, contents(out.path), seen};
}

bool has_terminals() {
  int terminal = -1, far_end = -1;
  if (::openpty(&terminal, &far_end, nullptr, nullptr, nullptr) != 0) return false;
  ::close(terminal);
  ::close(far_end);
  return true;
}

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string example(const std::string& name) {
  return std::string(PROJECT_ROOT) + "/harness/examples/" + name;
}

std::string WithFolder::file(const std::string& name, const std::string& text) const {
  std::ofstream(folder / name) << text;
  return in_folder(name);
}
