// SPDX-License-Identifier: MIT
// Files are written whole or not at all: to a neighbour first, then renamed.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace shakedown {

/// Replaces the file's contents. Throws FileError.
void write_file(const std::filesystem::path& file, std::string_view contents);

/// Makes sure, before long work, that a file can be written there (its folder is made when it is missing).
/// Throws FileError.
void expect_writable(const std::filesystem::path& file);

/// A folder for results.
class OutputFolder {
 public:
  /// Makes the folder when it is missing. Throws FileError when files cannot be written into it.
  explicit OutputFolder(std::filesystem::path folder);
  void write(const std::filesystem::path& name, std::string_view contents) const;
  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace shakedown
