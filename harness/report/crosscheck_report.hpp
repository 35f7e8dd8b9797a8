// SPDX-License-Identifier: MIT
#pragma once
#include "crosscheck.hpp"
#include "report.hpp"

namespace shakedown {

/// Makes the report of engines side by side, a section a setup.
Report report_of(const std::vector<Crosscheck>& crosschecks, const Setup& last_setup);

}  // namespace shakedown
