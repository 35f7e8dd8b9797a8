// SPDX-License-Identifier: MIT
#include "table_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

namespace shakedown {

namespace {

std::string unquoted(std::string_view cell) {
  cell = trimmed(cell);
  if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
  return std::string(trimmed(cell));
}

std::vector<std::string> split_at_blanks(std::string_view line) {
  std::vector<std::string> cells;
  line = trimmed(line);
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    cells.push_back(unquoted(line.substr(0, end)));
    line = trimmed(line.substr(end));
  }
  return cells;
}

}  // namespace

std::vector<std::string> split_cells(std::string_view line, char delimiter) {
  if (delimiter == ' ') return split_at_blanks(line);
  std::vector<std::string> cells;
  bool quoted = false;
  std::size_t start = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (line[i] != delimiter || quoted)) continue;
    cells.push_back(unquoted(line.substr(start, i - start)));
    start = i + 1;
  }
  return cells;
}

bool is_blank_cell(std::string_view cell) {
  static constexpr std::array<std::string_view, 16> words{"",    "nan", "NaN",     "NAN",   "NA",   "N/A",
                                                          "n/a", "-",   "null",    "NULL",  "None", "#N/A",
                                                          "#NV", "#NA", "#DIV/0!", "#WERT!"};
  return std::find(words.begin(), words.end(), cell) != words.end();
}

std::optional<double> cell_number(std::string_view cell, bool decimal_comma) {
  std::string text(cell.starts_with('+') ? cell.substr(1) : cell);
  if (decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return {};
  return value;
}

namespace {

/// Returns the share of the lines that have the commonest number of cells, times the share of numbers among
/// their cells; a single column counts nothing.
double evenness(const std::vector<std::string_view>& lines, char delimiter) {
  std::map<std::size_t, int> of_width;
  double numbers = 0, cells_in_all = 0;
  for (const std::string_view line : lines) {
    const std::vector<std::string> cells = split_cells(line, delimiter);
    ++of_width[cells.size()];
    for (const std::string& cell : cells) {
      if (is_blank_cell(cell)) continue;
      ++cells_in_all;
      numbers += cell_number(cell, false) || (delimiter != ',' && cell_number(cell, true));
    }
  }
  const auto commonest = std::max_element(of_width.begin(), of_width.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
  if (commonest == of_width.end() || commonest->first < 2 || cells_in_all == 0) return 0;
  return commonest->second * numbers / (cells_in_all * static_cast<double>(lines.size()));
}

}  // namespace

char find_delimiter(const std::vector<std::string_view>& lines) {
  // In this order: a decimal comma must not be taken for a delimiter when a better one is there.
  constexpr std::array<char, 4> candidates{'\t', ';', ',', ' '};
  char best = ',';
  double best_evenness = 0;
  for (const char candidate : candidates) {
    const double value = evenness(lines, candidate);
    if (value > best_evenness + 0.02) best = candidate, best_evenness = value;
  }
  return best;
}

}  // namespace shakedown
