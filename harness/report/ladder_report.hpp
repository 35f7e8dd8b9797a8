// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include "momentum.hpp"
#include "refit_result.hpp"
#include "report.hpp"

namespace shakedown {

/// One setup among several that are judged by the same measurements.
struct Rung {
  std::string setup;    ///< its file
  std::string effects;  ///< "plain", or those it has
  Refit fit;
  MomentumAudit momentum;
  std::optional<ModelJudgement> by_waveform{};  ///< of boxes without grains
  /// Returns the judgement by the waveform where there is one, else by ensembles and momentum balance.
  ModelJudgement judgement() const {
    return by_waveform ? *by_waveform
                       : judgement_of(fit.test(), momentum.test_of(momentum.as_given), fit.left());
  }
  bool holds() const { return judgement().holds(); }
};

/// Makes the report of a ladder; `last`: the last rung's setup.
Report report_of(const std::vector<Rung>& rungs, bool refitted, const Measurement& measurement,
                 const Setup& last);

}  // namespace shakedown
