// SPDX-License-Identifier: MIT
// Where a test writes.
#pragma once
#include <stdlib.h>  // mkdtemp

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

namespace shakedown {

/// A folder of its own, empty at first and gone with this object: neither tests in parallel nor two runs of
/// them meet in it.
class ScratchFolder {
 public:
  ScratchFolder() {
    // as mkdtemp wants it
    std::string name =
        (std::filesystem::temp_directory_path() / ("shakedown_test_" + std::string(6, 'X'))).string();
    if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  operator const std::filesystem::path&() const { return path_; }
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace shakedown
