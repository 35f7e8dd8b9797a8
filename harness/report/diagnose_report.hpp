// SPDX-License-Identifier: MIT
#pragma once
#include "diagnosis.hpp"
#include "measured_against_model.hpp"
#include "report.hpp"

namespace shakedown {

/// Makes the report of a diagnosis. `given`: the setup as the user had it. The curves must come from
/// measured_against_model() with the setup as given and Diagnosis::amended; `knobs`: what the reader may
/// turn.
Report report_of(const Diagnosis& diagnosis, const Measurement& measurement, const Setup& given,
                 const std::vector<MeasuredAgainstModel>& curves, ReportKnobs knobs = {});

}  // namespace shakedown
