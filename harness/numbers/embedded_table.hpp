// SPDX-License-Identifier: MIT
// A table that the build put into the program as text (shakedown_embedded in the top CMakeLists.txt): rows of
// words with commas between them, a line of titles first, lines that begin with # left out.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// Returns the rows below the titles, each with as many words as there are titles; spaces around words are
/// dropped.
std::vector<std::vector<std::string>> embedded_rows(std::string_view table);

}  // namespace shakedown
