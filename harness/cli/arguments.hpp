// SPDX-License-Identifier: MIT
// Prepares the words that the program was called with.
#pragma once
#include <string>
#include <vector>

namespace shakedown {

/// Returns the words after the program's name in the reverse order that the parser wants. Throws InputError
/// where a word is no UTF-8 text, for results could not name it, or has control characters, or where an
/// option for a file names none ("--out=").
std::vector<std::string> parser_words(int count, char** words);

}  // namespace shakedown
