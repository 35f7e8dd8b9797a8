// SPDX-License-Identifier: MIT
// Lists with commas, as people write them after an option.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace shakedown {

/// "a,b=c" parts at commas that stand outside quotes and brackets, trimmed; of an empty text one empty part.
std::vector<std::string> split_at_commas(std::string_view text);

/// The same of an option that may be left out: no names of an empty text.
std::vector<std::string> names_in(std::string_view text);

/// Without the spaces at both ends.
std::string stripped(std::string_view text);

}  // namespace shakedown
