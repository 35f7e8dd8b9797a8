// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// Rows of a table of numbers.
using NumberTable = std::vector<std::vector<double>>;

/// "line 17, column 3: 'nan' is no finite number"
struct TableProblem {
  std::string text;
};

/// Reads rows of exactly `columns` finite numbers from the line `first_line` (the first is 1) on; empty lines
/// count for nothing. Throws TableProblem.
NumberTable number_table(std::string_view text, char between, std::size_t columns, std::size_t first_line);

}  // namespace shakedown
