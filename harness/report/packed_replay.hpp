// SPDX-License-Identifier: MIT
// Packs motion into as few bytes as a page needs.
#pragma once
#include <string>

#include "report.hpp"

namespace shakedown {

/// Points of a replay in whole time and length units, columns of zigzag 7-bit numbers (page/replay.js reads
/// them).
struct PackedReplay {
  std::string bytes;
  double time_unit = 2e-6;    ///< s
  double length_unit = 2e-6;  ///< m
};
/// Returns a replay packed: of every grain, then of the box, its times with their contacts, then its x, y and
/// z.
PackedReplay packed(const ReportReplay& replay);

}  // namespace shakedown
