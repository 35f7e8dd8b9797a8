// SPDX-License-Identifier: MIT
// Reads options whose value is a number with its unit.
#pragma once
#include <string>
#include <string_view>

namespace shakedown {

/// Returns the value in SI, of the dimension of `unit`; `otherwise` where the text is empty: the option was
/// not given. Throws InputError. `example`: a number that suits the unit.
double quantity_option(const char* option, const std::string& text, std::string_view unit, double otherwise,
                       std::string_view example = "1");

}  // namespace shakedown
