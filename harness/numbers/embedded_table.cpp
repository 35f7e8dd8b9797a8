// SPDX-License-Identifier: MIT
#include "embedded_table.hpp"

#include "expect.hpp"

namespace shakedown {

namespace {

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == text.npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (;;) {
    const std::size_t comma = line.find(',');
    words.push_back(trimmed(line.substr(0, comma)));
    if (comma == line.npos) return words;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

std::vector<std::vector<std::string>> embedded_rows(std::string_view table) {
  std::vector<std::vector<std::string>> rows;
  while (!table.empty()) {
    const std::size_t end = table.find('\n');
    const std::string_view line = table.substr(0, end);
    table.remove_prefix(end == table.npos ? table.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    rows.push_back(words_of(line));
    EXPECT(rows.back().size() == rows.front().size());
  }
  EXPECT(!rows.empty());
  rows.erase(rows.begin());
  return rows;
}

}  // namespace shakedown
