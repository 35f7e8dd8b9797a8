// SPDX-License-Identifier: MIT
// Makes an experiment file from bare tables: which column is what, in which unit, as far as names and numbers
// tell.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "column_guess.hpp"

namespace shakedown {

struct ImportedTables {
  std::string experiment;  ///< text of an experiment file
  std::string preview;     ///< what was found, for people
  std::vector<GuessedColumn> columns;
  std::vector<std::string> open_questions;  ///< what the user must fill in before the file can be used
};

/// What no table says, as it stands in an experiment file ("240 Hz"); empty: asked for where it is needed.
struct ImportOptions {
  std::string frame_rate, pixel_size, origin;
  std::vector<std::string> lengths{};  ///< of the box in each table, or one for all
};

/// Guesses one layout for all tables (of one camera and one tracker). `relative_to`: folder in which the
/// experiment file will stand. Throws InputError when a table cannot be read or lacks a column of the first
/// one's layout or an option is no such quantity, FileError.
ImportedTables import_tables(const std::vector<std::filesystem::path>& files,
                             const std::filesystem::path& relative_to, const ImportOptions& options = {});

}  // namespace shakedown
