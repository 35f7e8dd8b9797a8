// SPDX-License-Identifier: MIT
#include "errors.hpp"

#include <algorithm>
#include <string_view>

namespace shakedown {

namespace {

/// Control characters of the input would reach the terminal, and a NUL would end the message: they are
/// written as \\x1b.
std::string printable(std::string_view text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte >= 0x20 && byte != 0x7f) || c == '\n' || c == '\t')
      shown += c;
    else
      shown += std::string("\\x") + "0123456789abcdef"[byte >> 4] + "0123456789abcdef"[byte & 15];
  }
  return shown;
}

}  // namespace

std::string to_string(const Violation& violation) {
  std::string text;
  if (!violation.place.file.empty()) {
    text += violation.place.file;
    if (violation.place.line > 0)
      text += ":" + std::to_string(violation.place.line) + ":" + std::to_string(violation.place.column);
    text += ": ";
  }
  if (!violation.key.empty()) text += violation.key + ": ";
  text += violation.problem;
  if (!violation.remedy.empty()) text += "; " + violation.remedy;
  return printable(text);
}

namespace {

/// As many as somebody reads; what is left is counted.
constexpr std::size_t most_shown = 100;

std::string joined(const std::vector<Violation>& violations) {
  std::string text;
  for (std::size_t i = 0; i < std::min(violations.size(), most_shown); ++i)
    text += (text.empty() ? "" : "\n") + to_string(violations[i]);
  if (violations.size() > most_shown)
    text += "\nand " + std::to_string(violations.size() - most_shown) + " more";
  return text;
}

}  // namespace

InputError::InputError(std::vector<Violation> found)
    : std::runtime_error(joined(found)), violations(std::move(found)) {}

}  // namespace shakedown
