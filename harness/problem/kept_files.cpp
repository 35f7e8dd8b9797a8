// SPDX-License-Identifier: MIT
#include "kept_files.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>
#include <string>

#include "errors.hpp"

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

}  // namespace

std::filesystem::path one_name_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path absolute = std::filesystem::absolute(file, error),
                              plain = std::filesystem::weakly_canonical(absolute, error),
                              place = error ? absolute.lexically_normal() : plain;
  return place.has_filename() ? place : place.parent_path();
}

void begin_keeping_files() { kept().counting = true; }

void expect_no_pipe(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status there = fs::status(file, ignored);
  // What a shell hands over, `run <(...)` or `... | run /dev/stdin`, ends when its writer does.
  const std::string name = file.string();
  const bool handed_over =
      name.starts_with("/dev/fd/") || name.starts_with("/proc/self/fd/") || name == "/dev/stdin";
  if (fs::is_fifo(there) && handed_over) return;
  if (fs::is_fifo(there) || fs::is_character_file(there) || fs::is_block_file(there) || fs::is_socket(there))
    throw FileError(
        name +
        ": is a pipe or a device, and reading it may never end; write what it gives into a file and "
        "name that");
}

void keep_unchanged(const std::filesystem::path& file) {
  expect_no_pipe(file);
  if (!kept().counting) return;
  const std::string name = one_name_of(file).string();
  const std::lock_guard lock(kept().mutex);
  kept().files.insert(name);
}

bool is_kept_unchanged(const std::filesystem::path& file) {
  if (!kept().counting) return false;
  const std::string name = one_name_of(file).string();
  const std::lock_guard lock(kept().mutex);
  return kept().files.contains(name);
}

void cannot_be_read(const std::filesystem::path& file, const std::string& part) {
  if (file.empty()) throw FileError("the name of a file to read is empty; name a file");
  std::error_code ignored;
  std::string why = part;
  const bool folder = std::filesystem::is_directory(file, ignored);
  if (folder || ::access(file.c_str(), R_OK) != 0)
    why += (why.empty() ? "" : ", ") + std::string(folder ? "it is a folder" : std::strerror(errno));
  throw FileError(file.string() + ": cannot be read" + (why.empty() ? "" : " (" + why + ")") +
                  "; check the path and its permissions");
}

}  // namespace shakedown
