// SPDX-License-Identifier: MIT
// Text inside HTML and SVG.
#pragma once
#include <string>
#include <string_view>

namespace shakedown {

/// Returns the text with `& < > " '` as entities; line breaks stay.
std::string escaped(std::string_view text);

}  // namespace shakedown
