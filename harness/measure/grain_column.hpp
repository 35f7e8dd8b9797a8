// SPDX-License-Identifier: MIT
// Grains cannot leave their box: a centre that does is in another unit, on the wrong side or of something
// else.
#pragma once
#include <optional>
#include <vector>

#include "value_reading.hpp"

namespace shakedown {

/// `x_box`, `x_com`: m, NaN where missing, without wrong frames; `length`: m, of the box inside. Nothing
/// where the centre stays within the box.
std::optional<Problem> problem_of_grains(const std::vector<double>& x_box, const std::vector<double>& x_com,
                                         double length);

}  // namespace shakedown
