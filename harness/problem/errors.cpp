// SPDX-License-Identifier: MIT
#include "errors.hpp"

#include <algorithm>

#include "text.hpp"

namespace shakedown {

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
