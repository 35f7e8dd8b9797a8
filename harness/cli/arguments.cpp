// SPDX-License-Identifier: MIT
#include "arguments.hpp"

#include <algorithm>
#include <string_view>

#include "errors.hpp"
#include "named_files.hpp"

namespace shakedown {

namespace {

/// Returns how many bytes the character takes that begins with this one; 0: none begins so.
std::size_t length_of_character(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

bool is_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = length_of_character(byte(at));
    if (length == 0 || at + length > text.size()) return false;
    for (std::size_t i = at + 1; i < at + length; ++i)
      if ((byte(i) & 0xc0) != 0x80) return false;
    // longer than need be, half of a pair, or beyond the last character
    if (length > 2 &&
        ((byte(at) == 0xe0 && byte(at + 1) < 0xa0) || (byte(at) == 0xed && byte(at + 1) > 0x9f) ||
         (byte(at) == 0xf0 && byte(at + 1) < 0x90) || (byte(at) == 0xf4 && byte(at + 1) > 0x8f)))
      return false;
    at += length;
  }
  return true;
}

/// Line ends and tabs may stand in a formula.
bool is_control_character(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
}

bool has_control_characters(std::string_view text) {
  const auto second_set = [&](std::size_t i) {  // U+0080 to U+009F
    return static_cast<unsigned char>(text[i]) == 0xc2 && static_cast<unsigned char>(text[i + 1]) < 0xa0;
  };
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (second_set(i)) return true;
  return std::any_of(text.begin(), text.end(), is_control_character);
}

/// Returns a text that is no UTF-8 as a message can show it.
std::string with_bytes_named(std::string_view text) {
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    shown += byte < 0x80 && !is_control_character(c)
                 ? std::string(1, c)
                 : std::string("\\x") + "0123456789abcdef"[byte >> 4] + "0123456789abcdef"[byte & 15];
  }
  return shown;
}

/// "--out=": the parser's own words for it say less.
bool names_nothing(std::string_view word) {
  return std::any_of(options_for_files.begin(), options_for_files.end(),
                     [&](const char* option) { return word == "--" + std::string(option) + "="; });
}

}  // namespace

std::vector<std::string> parser_words(int count, char** words) {
  std::vector<std::string> arguments(words + std::min(count, 1), words + count);
  std::vector<Violation> found;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (!is_utf8(arguments[i]))
      found.push_back({{},
                       with_bytes_named(arguments[i]),
                       "is no UTF-8 text (results could not name it)",
                       "rename the file or folder"});
    if (has_control_characters(arguments[i]))
      found.push_back({{},
                       with_bytes_named(arguments[i]),
                       "has control characters (terminals obey them)",
                       "rename the file or folder, or leave them out"});
    if (names_nothing(arguments[i]))
      found.push_back({{},
                       arguments[i].substr(0, arguments[i].size() - 1),
                       "has an empty name",
                       "name a file or folder, or leave the option out"});
    // "--json" may go without a file; a setup after it is the setup, not a file to overwrite.
    if (i + 1 < arguments.size() && arguments[i] == "--json" && arguments[i + 1].ends_with(".toml"))
      arguments[i] = "--json=-";
  }
  if (!found.empty()) throw InputError(std::move(found));
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

}  // namespace shakedown
