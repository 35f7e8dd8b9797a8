// SPDX-License-Identifier: MIT
#include "toml_string.hpp"

namespace shakedown {

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (c == '\n')
      result += "\\n";
    else if (c == '\t')
      result += "\\t";
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      constexpr std::string_view hex = "0123456789ABCDEF";
      ((result += "\\u00") += hex[static_cast<unsigned char>(c) >> 4]) += hex[c & 15];
    } else
      result += c;
  }
  return result + '"';
}

}  // namespace shakedown
