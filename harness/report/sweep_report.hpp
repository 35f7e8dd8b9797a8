// SPDX-License-Identifier: MIT
#pragma once
#include "report.hpp"
#include "result_file.hpp"

namespace shakedown {

/// The report of a sweep's results, whatever is in the file by now.
Report report_of(const ResultFile& file, const std::string& name);

}  // namespace shakedown
