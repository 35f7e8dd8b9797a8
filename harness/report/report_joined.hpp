// SPDX-License-Identifier: MIT
#pragma once
#include "report.hpp"

namespace shakedown {

struct NamedReport {
  std::string name;  ///< of the folder it came from
  Report report;
};

/// Joins several reports to one: their verdicts as a table, then each one's sections, titles and groups told
/// apart by name. One alone stays as it is.
Report joined(std::vector<NamedReport> reports);

}  // namespace shakedown
