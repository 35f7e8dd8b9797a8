// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstdio>
#include <string>

namespace shakedown {

/// Returns the text that printf writes, up to 399 bytes.
std::string text_of(const char* format, auto... values) {
  std::array<char, 400> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace shakedown
