// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdio>
#include <string>

namespace shakedown {

/// Numbers in words, as printf writes them.
std::string text_of(const char* format, auto... values) {
  std::array<char, 400> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace shakedown
