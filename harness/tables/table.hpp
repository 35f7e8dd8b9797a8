// SPDX-License-Identifier: MIT
// Reads a table of numbers as the program that made it wrote it: delimiter, decimal sign, header rows and
// units are found from the text.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "errors.hpp"

namespace shakedown {

struct TableColumn {
  std::string name;  ///< as in the header, without a unit in brackets; "track.x" where several tracks stand
                     ///< side by side
  std::string unit;  ///< as written in the header, e.g. "mm"; empty: not said
  std::vector<double>
      value;  ///< one entry a row, in the column's own unit; NaN where the cell is blank or not a number
  struct TextCell {
    std::size_t row = 0;
    std::string text;
  };
  std::vector<TextCell> not_numbers;  ///< cells that are neither blank nor a finite number
};

struct Table {
  std::string file;
  char delimiter = ',';  ///< ' ' stands for any white space
  bool decimal_comma = false;
  int header_lines = 0;  ///< lines before the first row of data
  std::vector<TableColumn> columns;
  std::vector<int> line;                            ///< of each row in the file, from 1
  bool latin = false;                               ///< was not UTF-8; its letters were read as Latin-1
  std::vector<Violation> violations;                ///< rows with too few or too many cells
  std::size_t rows() const { return line.size(); }  ///< number of rows of data
};

/// Reads a table. Throws FileError when the file cannot be read, InputError when it is not a table of
/// numbers.
Table read_table(const std::filesystem::path& file);

/// Reads a table from text in the same way; `name` stands for the file in messages.
Table parse_table(std::string_view text, const std::string& name);

/// Returns the column of this name; nullptr when there is none.
const TableColumn* find_column(const Table& table, std::string_view name);

/// Returns the column that tells tracks apart in a table with one row a track and frame, by the headers that
/// trackers write; nullptr when there is none.
const TableColumn* find_track_column(const Table& table);

/// Returns the names of all columns.
std::vector<std::string> column_names(const Table& table);

}  // namespace shakedown
