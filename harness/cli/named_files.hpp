// SPDX-License-Identifier: MIT
// The names of all files that one command is given.
#pragma once
#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>

namespace shakedown {

/// Options that take the name of a file or folder, without their dashes.
constexpr std::array options_for_files{"data", "out", "report", "table", "truth", "keep", "known"};

/// Throws InputError where a parsed command is given an empty name, where two of its options name one file to
/// write, or where one names a file in the folder of --out that the command's own results replace.
void check_named_files(const CLI::App& command);

/// Tells whether commands write files of this name or ending into their folders.
bool is_result(const std::filesystem::path& file);

}  // namespace shakedown
