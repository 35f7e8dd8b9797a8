// SPDX-License-Identifier: MIT
#include "number_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "text.hpp"

namespace shakedown {

namespace {

double number_of(std::string_view cell, std::size_t line, std::size_t column) {
  cell = trimmed(cell);
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (problem != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
    constexpr std::size_t most_shown = 40;
    throw TableProblem{fmt::format("line {}, column {}: '{}' is no finite number", line, column,
                                   printable(cell.substr(0, most_shown)))};
  }
  return value;
}

std::vector<double> numbers_of(std::string_view text, char between, std::size_t line) {
  std::vector<double> row;
  for (bool more = true; more;) {
    const std::size_t end = text.find(between);
    more = end != std::string_view::npos;
    row.push_back(number_of(text.substr(0, end), line, row.size() + 1));
    if (more) text.remove_prefix(end + 1);
  }
  return row;
}

}  // namespace

NumberTable number_table(std::string_view text, char between, std::size_t columns, std::size_t first_line) {
  NumberTable rows;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view row = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line < first_line || row.empty()) continue;
    rows.push_back(numbers_of(row, between, line));
    if (rows.back().size() != columns)
      throw TableProblem{
          fmt::format("line {}: {} columns where {} are due", line, rows.back().size(), columns)};
  }
  return rows;
}

}  // namespace shakedown
