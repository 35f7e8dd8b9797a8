// SPDX-License-Identifier: MIT
// Files are written whole or not at all: to a neighbour first, then renamed. None replaces a file that the
// command reads, a link, a device or a pipe.
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// A file that grows piece by piece and stands in its place when it is whole; without finish() nothing is
/// left of it. Every function throws FileError, with the reason and what to do.
class GrowingFile {
 public:
  /// Makes the folder when it is missing.
  explicit GrowingFile(std::filesystem::path file);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Appends the text. Throws FileError when the disk is full.
  void add(std::string_view text);
  /// Puts the file in its place.
  void finish();

 private:
  std::filesystem::path file_, neighbour_;
  int descriptor_ = -1;
  std::string waiting_;  // not yet handed to the system
  /// Hands what waits to the system. Throws FileError when the disk is full.
  void hand_over();
};

/// Replaces the file's contents. Throws FileError.
void write_file(const std::filesystem::path& file, std::string_view contents);

/// Makes sure, before long work, that a file can be written there (its folder is made when it is missing).
/// Throws FileError.
void expect_writable(const std::filesystem::path& file);

/// A folder for results.
class OutputFolder {
 public:
  /// Whether other programs may write into the folder at the same time.
  enum class Use { shared, alone };

  /// Makes the folder when it is missing. Throws FileError when files cannot be written into it, or when it
  /// is to be used alone and another program does so. Alone it is used until the last copy of this is gone.
  explicit OutputFolder(std::filesystem::path folder, Use use = Use::shared);
  /// Replaces the contents of a file in the folder. Throws FileError.
  void write(const std::filesystem::path& name, std::string_view contents) const;
  /// Removes files of an earlier command that the present one may not write again, and folders that this
  /// leaves empty; what the command reads stays.
  void remove(const std::vector<std::filesystem::path>& names) const;
  const std::filesystem::path& path() const { return folder_; }

 private:
  class Lock;
  std::filesystem::path folder_;
  std::shared_ptr<const Lock> lock_;
};

}  // namespace shakedown
