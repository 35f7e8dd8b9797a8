// SPDX-License-Identifier: MIT
// Writes the map of smallest strengths as text, JSON and page.
#pragma once
#include <string>

#include "report.hpp"
#include "strength_map.hpp"

namespace shakedown {

/// Returns tables, one for each thing that is varied.
std::string map_text(const StrengthMap& map);
/// Returns the map as JSON text; harness/README.md lists its keys.
std::string map_json(const StrengthMap& map);
/// Returns the page. `setup`: as believed; `design`: the experiment in a few words.
Report report_of(const StrengthMap& map, const Setup& setup, const std::string& design);

}  // namespace shakedown
