// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include "hidden_question.hpp"
#include "json_output.hpp"
#include "report_output.hpp"

namespace shakedown {

/// The options of `shakedown hide --map`.
struct MapArguments {
  bool wanted = false, resume = false;
  double seconds = 600;
  ReportOutput report;
};

/// Prints the map of smallest strengths of what `trial` would measure; keeps it, and its simulations until it
/// is whole, in the folder `out` (empty: nowhere). Returns the exit code.
int map_strengths(const MapArguments& arguments, const HiddenQuestion& question, const Trial& trial,
                  const std::string& out, const JsonOutput& json);

}  // namespace shakedown
