// SPDX-License-Identifier: MIT
// What the momentum balance found, as a diagnosis goes on with it.
#pragma once
#include <string>
#include <vector>

#include "state.hpp"

namespace shakedown {

/// Whether the user lets this effect be added.
bool allowed(const DiagnoseOptions& options, const std::string& effect);

/// What the balance found goes in at the strength that it finds and stays near it: chaos does not touch the
/// balance, and it knows strengths five times better than ensembles do.
DiagnosisState with_balance(DiagnosisState state, const std::vector<FoundTerm>& terms,
                            const Measurement& measurement, const Engine& engine,
                            const DiagnoseOptions& options, std::vector<std::string>& notes);

/// Names of the effects that the balance found.
std::vector<std::string> effects_of(const MomentumAudit& balance);

/// The sets that the balance weighed; nothing missing where there is none.
std::vector<Hypothesis> hypotheses_of(const MomentumAudit& balance);

}  // namespace shakedown
