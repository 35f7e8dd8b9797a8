// SPDX-License-Identifier: MIT
// Sections that reports of comparisons, fits and diagnoses have alike.
#pragma once
#include <string>
#include <vector>

#include "momentum.hpp"
#include "nuisance_found.hpp"
#include "refit_result.hpp"
#include "report.hpp"
#include "validation.hpp"

namespace shakedown {

/// Makes the table of E, u_num, u_input, u_D and u_val of each observable of each run.
ReportTable validation_table(const std::vector<Validation>& rows);

/// Shows the error of each run as bars beside what noise and spread make, mm.
ReportSection errors_section(const std::string& title, const std::vector<RunComparison>& runs);

/// Shows what the data say of what was known to an error only, counted from what was believed.
ReportSection nuisances_section(const std::vector<NuisanceFound>& found);

/// Makes the section of the momentum balance: forces that the model lacks, and their curves.
ReportSection momentum_section(const MomentumAudit& momentum);

}  // namespace shakedown
