// SPDX-License-Identifier: MIT
#pragma once
#include "report.hpp"
#include "result_file.hpp"

namespace shakedown {

/// The report of a sweep's results, whatever is in the file by now.
Report report_of(const ResultFile& file, const std::string& name);

/// What stands out, in a sentence: where a driven box swings most, or where the energy is gone soonest, or
/// where least of it is left.
std::string finding_of(const SweepIdentity& identity, const std::vector<PointSummary>& points);

}  // namespace shakedown
