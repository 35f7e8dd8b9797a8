// SPDX-License-Identifier: MIT
// Numbers and motion as few bytes as a page needs.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report.hpp"

namespace shakedown {

/// Numbers in units of a quantum, as differences from one to the next. The quantum is a power of ten below
/// the largest divided by `parts`: as a rule far below what a screen shows.
struct PackedNumbers {
  double quantum = 1;
  std::vector<std::optional<std::int64_t>>
      steps;  ///< nothing for a gap (NaN), over which the next one goes on
};
constexpr double parts_of_a_screen = 40000;
PackedNumbers packed(const std::vector<double>& values, double parts = parts_of_a_screen);

/// Points of a replay in whole time and length units, columns of zigzag 7-bit numbers (page/replay.js reads
/// them).
struct PackedReplay {
  std::string bytes;
  double time_unit = 2e-6;    ///< s
  double length_unit = 2e-6;  ///< m
};
PackedReplay packed(const ReportReplay& replay);

/// A gzip stream of the bytes, and bytes as base64 text (RFC 4648).
std::string gzip(std::string_view bytes);
std::string base64(std::string_view bytes);

}  // namespace shakedown
