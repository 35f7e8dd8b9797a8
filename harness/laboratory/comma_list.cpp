// SPDX-License-Identifier: MIT
#include "comma_list.hpp"

namespace shakedown {

std::string stripped(std::string_view text) {
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return std::string(text);
}

std::vector<std::string> split_at_commas(std::string_view text) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (quoted) continue;
    depth += text[i] == '(' || text[i] == '[' || text[i] == '{';
    depth -= text[i] == ')' || text[i] == ']' || text[i] == '}';
    if (text[i] != ',' || depth > 0) continue;
    parts.push_back(stripped(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  parts.push_back(stripped(text.substr(begin)));
  return parts;
}

std::vector<std::string> names_in(std::string_view text) {
  return text.empty() ? std::vector<std::string>{} : split_at_commas(text);
}

}  // namespace shakedown
