// SPDX-License-Identifier: MIT
#include "errors.hpp"

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
  return text;
}

namespace {
std::string joined(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& violation : violations) text += (text.empty() ? "" : "\n") + to_string(violation);
  return text;
}
}  // namespace

InputError::InputError(std::vector<Violation> found)
    : std::runtime_error(joined(found)), violations(std::move(found)) {}

}  // namespace shakedown
