// SPDX-License-Identifier: MIT
// Splits lists with commas, as people write them after an option.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// Splits "a,b=c" at commas that stand outside quotes and brackets, and trims the parts; an empty text has
/// one empty part.
std::vector<std::string> split_at_commas(std::string_view text);

/// Splits the text of an option that may be left out: an empty text has no names.
std::vector<std::string> names_in(std::string_view text);

}  // namespace shakedown
