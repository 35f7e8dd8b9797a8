// SPDX-License-Identifier: MIT
// Files that a command reads and must leave as they are.
#pragma once
#include <filesystem>

namespace shakedown {

/// From now on keep_unchanged() counts. Programs with commands call it first; a library's other callers may
/// replace what they have read.
void begin_keeping_files();

/// This file is the user's (read as an input, or where the results of this command go): whatever else the
/// command writes may not replace it. Any thread may call it; the file need not exist.
void keep_unchanged(const std::filesystem::path& file);

/// Whether writing to `file`, by whatever path, would replace a file that is kept.
bool is_kept_unchanged(const std::filesystem::path& file);

}  // namespace shakedown
