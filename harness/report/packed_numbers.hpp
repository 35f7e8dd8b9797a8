// SPDX-License-Identifier: MIT
// Numbers and motion as few bytes as a page needs.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "report.hpp"

namespace shakedown {

/// Numbers in units of a quantum, as differences from one to the next: {"q": quantum, "d": [...]}, null for a
/// gap (NaN). The quantum is a power of ten below a 40000th of the largest, far below what a screen shows.
std::string packed_json(const std::vector<double>& values);

/// Points of a replay in whole time and length units, columns of zigzag 7-bit numbers (page/replay.js reads
/// them).
struct PackedReplay {
  std::string bytes;
  double time_unit = 2e-6;    ///< s
  double length_unit = 2e-6;  ///< m
};
PackedReplay packed(const ReportReplay& replay);

std::string gzip(std::string_view bytes);
std::string base64(std::string_view bytes);

}  // namespace shakedown
