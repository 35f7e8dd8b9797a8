// SPDX-License-Identifier: MIT
#pragma once
#include "decay_comparison.hpp"
#include "judgement.hpp"
#include "measured_against_model.hpp"
#include "momentum.hpp"
#include "refit_result.hpp"
#include "report.hpp"
#include "validation.hpp"

namespace shakedown {

/// What a comparison found. All outlive it.
struct ComparedModel {
  const Refit& fit;
  const MomentumAudit& momentum;
  const ModelJudgement& judgement;
  const std::vector<DecayComparison>& decays;
};

/// The report of a comparison; the curves must come from measured_against_model() with this setup alone;
/// `knobs`: what the reader may turn.
Report report_of(const ComparedModel& found, const Measurement& measurement, const Setup& setup,
                 const std::vector<MeasuredAgainstModel>& curves, ReportKnobs knobs = {});

}  // namespace shakedown
