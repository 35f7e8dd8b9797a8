// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <string_view>

namespace shakedown {

/// Returns the text as a TOML string, quoted and escaped.
std::string toml_string(std::string_view text);

}  // namespace shakedown
