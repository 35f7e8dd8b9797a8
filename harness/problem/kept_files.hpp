// SPDX-License-Identifier: MIT
// Files that a command reads and must leave as they are.
#pragma once
#include <filesystem>
#include <string>

namespace shakedown {

/// Makes keep_unchanged() count from now on. Programs with commands call it first; a library's other callers
/// may replace what they have read.
void begin_keeping_files();

/// Returns one name for each place, whatever path leads to it: absolute, without links and dots.
std::filesystem::path one_name_of(const std::filesystem::path& file);

/// Declares a file the user's (read as an input, or where the results of this command go): whatever else the
/// command writes may not replace it. Any thread may call it; the file need not exist. Throws FileError as
/// expect_no_pipe() does.
void keep_unchanged(const std::filesystem::path& file);

/// Throws FileError where a named pipe or a device stands in the file's place: reading it may never end.
/// Pipes that a shell hands over (/dev/fd, /dev/stdin) are read.
void expect_no_pipe(const std::filesystem::path& file);

/// Tells whether writing to `file`, by whatever path, would replace a file that is kept.
bool is_kept_unchanged(const std::filesystem::path& file);

/// Says that a file cannot be read, with the reason where there is one (`file` is missing, a folder, not ours
/// to read), and what to do. `part`: what the file is for, "release.initial_grains"; may be empty.
[[noreturn]] void cannot_be_read(const std::filesystem::path& file, const std::string& part = {});

}  // namespace shakedown
