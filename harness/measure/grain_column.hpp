// SPDX-License-Identifier: MIT
// Checks the column of the grains' centre: grains cannot leave their box, so a centre that does is in another
// unit, on the wrong side or of something else.
#pragma once
#include <optional>
#include <vector>

#include "value_reading.hpp"

namespace shakedown {

/// Returns what is wrong with the centre; nothing where it stays within the box. `x_box`, `x_com`: m, NaN
/// where missing, without wrong frames; `length`: m, of the box inside.
std::optional<Problem> problem_of_grains(const std::vector<double>& x_box, const std::vector<double>& x_com,
                                         double length);

}  // namespace shakedown
