// SPDX-License-Identifier: MIT
// Cells of delimited text.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text.hpp"

namespace shakedown {

/// Returns the cells of a line, trimmed and without quotes; delimiter ' ' splits at any run of blanks and
/// tabs.
std::vector<std::string> split_cells(std::string_view line, char delimiter);

/// Tells whether a cell is blank, or one of the usual words for "no value" (nan, NA, null, -).
bool is_blank_cell(std::string_view cell);

/// Returns the finite number in a cell; nothing when it is not one.
std::optional<double> cell_number(std::string_view cell, bool decimal_comma);

/// Returns the delimiter that splits these lines of data most evenly into numbers.
char find_delimiter(const std::vector<std::string_view>& lines);

}  // namespace shakedown
