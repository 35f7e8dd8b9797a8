// SPDX-License-Identifier: MIT
#include "kept_files.hpp"

#include <atomic>
#include <mutex>
#include <set>
#include <string>

namespace shakedown {

namespace {

struct Kept {
  std::atomic<bool> counting{false};
  std::mutex mutex;
  std::set<std::string> files;  ///< without links and dots
};

Kept& kept() {
  static Kept files;
  return files;
}

/// One name for each file, whatever path leads to it.
std::string one_name_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(file, error);
  const std::filesystem::path plain = std::filesystem::weakly_canonical(absolute, error);
  return (error ? absolute.lexically_normal() : plain).string();
}

}  // namespace

void begin_keeping_files() { kept().counting = true; }

void keep_unchanged(const std::filesystem::path& file) {
  if (!kept().counting) return;
  const std::string name = one_name_of(file);
  const std::lock_guard lock(kept().mutex);
  kept().files.insert(name);
}

bool is_kept_unchanged(const std::filesystem::path& file) {
  if (!kept().counting) return false;
  const std::string name = one_name_of(file);
  const std::lock_guard lock(kept().mutex);
  return kept().files.contains(name);
}

}  // namespace shakedown
