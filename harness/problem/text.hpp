// SPDX-License-Identifier: MIT
// Small things that many texts need, once.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// Without white space at either end, and without a byte-order mark before it.
std::string_view trimmed(std::string_view text);

/// "a, b, c"
std::string joined(const std::vector<std::string>& words, std::string_view between = ", ");

/// A cell of a CSV table that may hold commas and quotation marks: in quotation marks, those inside doubled.
std::string csv_cell(std::string_view text);

/// With control characters written as \\x1b: those of an input or of a file's name would reach the terminal,
/// and a NUL would end the message. Line ends and tabs stay.
std::string printable(std::string_view text);

/// "40.1 mm": three significant digits.
std::string millimetres(double metres);

}  // namespace shakedown
