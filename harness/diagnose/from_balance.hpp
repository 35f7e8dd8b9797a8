// SPDX-License-Identifier: MIT
// Puts what the momentum balance found into a diagnosis.
#pragma once
#include <string>
#include <vector>

#include "state.hpp"

namespace shakedown {

/// Tells whether the user lets this effect be added.
bool allowed(const DiagnoseOptions& options, const std::string& effect);

/// Returns the state with what the balance found. It goes in at the strength that the balance finds and stays
/// near it: chaos does not touch the balance, and it knows strengths five times better than ensembles do.
DiagnosisState with_balance(DiagnosisState state, const std::vector<FoundTerm>& terms,
                            const Measurement& measurement, const Engine& engine,
                            const DiagnoseOptions& options, std::vector<std::string>& notes);

/// Returns the names of the effects that the balance found.
std::vector<std::string> effects_of(const MomentumAudit& balance);

/// Returns the sets that the balance weighed; only "nothing is missing" where there is no balance.
std::vector<Hypothesis> hypotheses_of(const MomentumAudit& balance);

}  // namespace shakedown
