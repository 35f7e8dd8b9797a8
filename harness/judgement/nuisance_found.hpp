// SPDX-License-Identifier: MIT
// Holds what the data show of numbers that are known to within an error only: camera, clock and weights.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace shakedown {

/// Holds one of them. Values are what the number is more than was believed, SI.
struct NuisanceFound {
  std::string name, unit;
  double deviation = 0;         ///< standard deviation beforehand
  double value = 0, error = 0;  ///< afterwards
};

/// Returns a line for each, under a title; empty without any.
std::string nuisances_text(const std::vector<NuisanceFound>& found);
/// Returns a list of objects: name, value, error, known_to and unit.
nlohmann::ordered_json nuisances_json(const std::vector<NuisanceFound>& found);

}  // namespace shakedown
