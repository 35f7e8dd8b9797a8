// SPDX-License-Identifier: MIT
#include "program_place.hpp"

#include <unistd.h>

#include <cstdlib>
#include <system_error>
#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace shakedown {

namespace {

namespace fs = std::filesystem;

fs::path this_program() {
  std::error_code unreadable;
  return fs::read_symlink("/proc/self/exe", unreadable);
}

const fs::path& faster_folder() {
  static const fs::path folder = fs::path("libexec") / "shakedown" / faster_level;
  return folder;
}

#if defined(__AVX2__) && defined(__FMA__)
constexpr bool is_faster = true;
#else
constexpr bool is_faster = false;
#endif

}  // namespace

fs::path program_folder(const fs::path& program) {
  const fs::path folder = program.parent_path();
  const fs::path prefix = folder.parent_path().parent_path().parent_path();
  return !prefix.empty() && folder == prefix / faster_folder() ? prefix / "bin" : folder;
}

fs::path program_folder() { return program_folder(this_program()); }

bool has_faster_level() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  // These ask whether the system saves the wide registers, too.
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi") ||
      !__builtin_cpu_supports("bmi2"))
    return false;
  unsigned a = 0, b = 0, c = 0, d = 0;
  constexpr unsigned movbe = 1U << 22, f16c = 1U << 29, lzcnt = 1U << 5;
  if (__get_cpuid(1, &a, &b, &c, &d) == 0 || (c & movbe) == 0 || (c & f16c) == 0) return false;
  return __get_cpuid(0x80000001, &a, &b, &c, &d) != 0 && (c & lzcnt) != 0;
#else
  return false;
#endif
}

fs::path faster_program(const fs::path& program) {
  const fs::path prefix = program.parent_path().parent_path();
  if (prefix.empty() || program.parent_path().filename() != "bin") return {};
  const fs::path faster = prefix / faster_folder() / program.filename();
  return access(faster.c_str(), X_OK) == 0 ? faster : fs::path();
}

void become_faster_program(char** words) {
  if (is_faster || std::getenv("SHAKEDOWN_PORTABLE") != nullptr || !has_faster_level()) return;
  if (const fs::path faster = faster_program(this_program()); !faster.empty()) execv(faster.c_str(), words);
}

}  // namespace shakedown
