// SPDX-License-Identifier: MIT
#include "output_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "errors.hpp"

namespace shakedown {

namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& file, const std::string& why) {
  throw FileError(file.string() + ": cannot be written (" + why +
                  "); choose another place or make room there");
}

std::filesystem::path neighbour_of(const std::filesystem::path& file) {
  std::filesystem::path neighbour = file;
  neighbour += ".partial-" + std::to_string(::getpid());  // two programs may write to one folder
  return neighbour;
}

void make_folder_of(const std::filesystem::path& file) {
  std::error_code error;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
  if (error) cannot_write(file, error.message());
}

}  // namespace

void write_file(const std::filesystem::path& file, std::string_view contents) {
  make_folder_of(file);
  const std::filesystem::path neighbour = neighbour_of(file);
  std::error_code ignored;
  errno = 0;
  std::ofstream stream(neighbour, std::ios::binary);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  if (!stream) {
    const std::string why = errno != 0 ? std::strerror(errno) : "the disk refused it";
    std::filesystem::remove(neighbour, ignored);
    cannot_write(file, why);
  }
  std::error_code error;
  std::filesystem::rename(neighbour, file, error);
  if (!error) return;
  std::filesystem::remove(neighbour, ignored);
  cannot_write(file, error.message());
}

void expect_writable(const std::filesystem::path& file) {
  if (file.filename().empty() || std::filesystem::is_directory(file)) cannot_write(file, "it is a folder");
  make_folder_of(file);
  const std::filesystem::path neighbour = neighbour_of(file);
  errno = 0;
  const bool opened = std::ofstream(neighbour).is_open();
  if (!opened) cannot_write(file, std::strerror(errno));
  std::error_code ignored;
  std::filesystem::remove(neighbour, ignored);
}

OutputFolder::OutputFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  expect_writable(folder_ / "summary.json");
}

void OutputFolder::write(const std::filesystem::path& name, std::string_view contents) const {
  write_file(folder_ / name, contents);
}

}  // namespace shakedown
