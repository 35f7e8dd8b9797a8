// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "packed_numbers.hpp"

namespace shakedown {

/// Returns {"q": quantum, "d": [steps]}, null for a gap (packed_numbers.hpp).
nlohmann::ordered_json packed_json(const std::vector<double>& values, double parts = parts_of_a_screen);

}  // namespace shakedown
