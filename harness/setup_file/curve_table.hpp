// SPDX-License-Identifier: MIT
// Turns a law that was measured point by point into a formula.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace shakedown {

/// Returns the formula of a curve through the points of a CSV table, SI: "curve(x, 0.01, -0.2, 0.02, -0.1)".
/// Its first line names the columns, the variable, `value` and what else there is, which is not read:
/// "x,force,error"; the variable ascends. Of a force the second column may be a damping, a stiffness or a
/// friction: "x,damping" is -v*curve(x, ...), "t,stiffness" -x*curve(t, ...), "x,friction"
/// -tanh(v/0.001)*curve(x, ...), which turns round within 1 mm/s and is 0 at rest. Lines that begin with #
/// are remarks. Throws InputError with file, line, reason and remedy.
std::string curve_through_table(const std::filesystem::path& file, std::string_view value);

}  // namespace shakedown
