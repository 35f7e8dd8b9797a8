// SPDX-License-Identifier: MIT
#pragma once
#include "paper.hpp"
#include "report.hpp"

namespace shakedown {

/// Makes one page of the paper on trial: statements, figures, the puzzle, and the grains in each box.
Report report_of(const Paper& paper);

}  // namespace shakedown
