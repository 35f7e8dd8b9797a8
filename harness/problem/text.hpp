// SPDX-License-Identifier: MIT
// Small functions that many texts need.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// Returns the text without white space at either end, and without a byte-order mark before it.
std::string_view trimmed(std::string_view text);

/// Joins words: "a, b, c".
std::string joined(const std::vector<std::string>& words, std::string_view between = ", ");

/// Returns a cell of a CSV table whose text may hold commas and quotation marks: in quotation marks, those
/// inside doubled.
std::string csv_cell(std::string_view text);

/// Returns the text with control characters written as \\x1b: those of an input or of a file's name would
/// reach the terminal, and a NUL would end the message. Line ends and tabs stay.
std::string printable(std::string_view text);

/// Returns a length in millimetres with three significant digits: "40.1 mm".
std::string millimetres(double metres);

}  // namespace shakedown
