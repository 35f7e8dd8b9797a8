// SPDX-License-Identifier: MIT
// The map of smallest strengths as text, JSON and page.
#pragma once
#include <string>

#include "report.hpp"
#include "strength_map.hpp"

namespace shakedown {

/// Tables, one for each thing that is varied.
std::string map_text(const StrengthMap& map);
/// harness/README.md lists its keys.
std::string map_json(const StrengthMap& map);
/// `setup`: as believed; `design`: the experiment in a few words.
Report report_of(const StrengthMap& map, const Setup& setup, const std::string& design);

}  // namespace shakedown
