// SPDX-License-Identifier: MIT
#include "errors.hpp"

#include <algorithm>

#include "text.hpp"

namespace shakedown {

namespace {

/// Returns beginning and end of a text that is too long to read: words of the user's own, such as a key, may
/// be of any length.
std::string shortened(const std::string& text) {
  constexpr std::size_t most = 2000, end = 200;
  if (text.size() <= most) return text;
  return text.substr(0, most - end) + " ... " + text.substr(text.size() - end);
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
  if (!violation.key.empty()) text += shortened(violation.key) + ": ";
  text += shortened(violation.problem);
  if (!violation.remedy.empty()) text += "; " + shortened(violation.remedy);
  return printable(text);
}

namespace {

/// A message shows as many violations, and as much text, as somebody reads; what is left is counted.
constexpr std::size_t most_shown = 100, longest_text = 50000;

std::string joined(const std::vector<Violation>& violations) {
  std::string text;
  std::size_t shown = 0;
  for (; shown < std::min(violations.size(), most_shown) && text.size() < longest_text; ++shown)
    text += (text.empty() ? "" : "\n") + to_string(violations[shown]);
  if (violations.size() > shown) text += "\nand " + std::to_string(violations.size() - shown) + " more";
  return text;
}

}  // namespace

InputError::InputError(std::vector<Violation> found)
    : std::runtime_error(joined(found)), violations(std::move(found)) {}

}  // namespace shakedown
