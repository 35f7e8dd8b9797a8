// SPDX-License-Identifier: MIT
#pragma once
#include "report.hpp"
#include "result_file.hpp"

namespace shakedown {

/// Makes the report of a sweep's results, whatever is in the file by now.
Report report_of(const ResultFile& file, const std::string& name);

/// Says in a sentence what stands out: where a driven box swings most, or where the energy is gone soonest,
/// or where least of it is left.
std::string finding_of(const SweepIdentity& identity, const std::vector<PointSummary>& points);

}  // namespace shakedown
