// SPDX-License-Identifier: MIT
#pragma once
#include "fit.hpp"
#include "measured_against_model.hpp"
#include "report.hpp"

namespace shakedown {

/// Makes the report of a fit; the curves must come from measured_against_model() with the setup as given and
/// Fit::fitted; `knobs`: what the reader may turn.
Report report_of(const Fit& fit, const Measurement& measurement,
                 const std::vector<MeasuredAgainstModel>& curves, ReportKnobs knobs = {});

}  // namespace shakedown
