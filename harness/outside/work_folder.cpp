// SPDX-License-Identifier: MIT
#include "work_folder.hpp"

#include <stdlib.h>  // mkdtemp

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <system_error>

#include "errors.hpp"
#include "output_file.hpp"

namespace shakedown {

WorkFolder::WorkFolder(const std::filesystem::path& kept) : temporary_(kept.empty()) {
  std::error_code problem;
  if (temporary_) {
    std::string name = (std::filesystem::temp_directory_path(problem) / "shakedown_XXXXXX").string();
    if (!problem && ::mkdtemp(name.data()) == nullptr) problem = {errno, std::generic_category()};
    path_ = name;
  } else {
    path_ = std::filesystem::absolute(kept);
    std::filesystem::create_directories(path_, problem);
  }
  if (problem)
    throw FileError(path_.string() + ": the folder for the files of an outside program cannot be made (" +
                    problem.message() + "). " +
                    (temporary_ ? "Set TMPDIR to a folder that may be written." : "Name another folder."));
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  if (temporary_) std::filesystem::remove_all(path_, ignored);
}

void WorkFolder::write(const std::string& name, std::string_view contents) const {
  if (!temporary_) return write_file(path_ / name, contents);
  std::ofstream file(path_ / name, std::ios::binary);
  file << contents << std::flush;
  if (!file)
    throw FileError((path_ / name).string() + ": cannot be written (" +
                    std::error_code(errno, std::generic_category()).message() +
                    "). Free space, or set TMPDIR to another folder.");
}

void WorkFolder::make_way(const std::string& name) const {
  if (temporary_) return;
  expect_writable(path_ / name);
  std::error_code ignored;
  std::filesystem::remove(path_ / name, ignored);
}

namespace {

std::filesystem::path asked_for;
std::mutex names_in_use;

}  // namespace

void keep_outside_files(const std::filesystem::path& folder) { asked_for = folder; }

std::filesystem::path kept_folder(const std::string& program, int run) {
  const char* variable = std::getenv("SHAKEDOWN_KEEP");
  std::filesystem::path folder = asked_for;
  if (folder.empty() && variable != nullptr) folder = variable;
  if (folder.empty()) return {};
  folder = folder / program / ("run_" + std::to_string(run));
  static std::map<std::filesystem::path, int> used;
  const std::scoped_lock lock(names_in_use);
  const int before = used[folder]++;
  if (before > 0) folder += "_" + std::to_string(before + 1);
  return folder;
}

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string end_of(const std::filesystem::path& file, std::size_t most) {
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) return {};
  const auto size = static_cast<std::size_t>(in.tellg());
  const std::size_t from = size > most ? size - most : 0;
  in.seekg(static_cast<std::streamoff>(from));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t line = text.find('\n');
  if (from > 0 && line != std::string::npos) text.erase(0, line + 1);
  return text;
}

}  // namespace shakedown
