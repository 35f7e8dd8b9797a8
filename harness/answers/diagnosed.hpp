// SPDX-License-Identifier: MIT
// Checks what a diagnosis is asked, and writes what comes of it beside its numbers.
#pragma once
#include <string>
#include <vector>

#include "diagnosis.hpp"
#include "execution.hpp"
#include "report.hpp"

namespace shakedown {

/// Throws InputError where a name is no effect, or no parameter that a diagnosis fits.
void check_diagnosed_names(const std::vector<std::string>& effects, const std::vector<std::string>& fixed);

/// Returns the options of every diagnosis: all effects of the list, with the differences of the engines
/// known.
DiagnoseOptions usual_diagnose_options();

/// Returns the setup with effects and refitted values as TOML, and why.
std::string amended_setup(const Diagnosis& diagnosis);

/// Says how much is simulated for a page.
struct PageOptions {
  Execution execution{};
  double seconds = 0;  ///< of the diagnosis; what its knobs do has a fifth of that, and 20 s at least
};

/// Returns the page; its curves and what its knobs do are simulated here. `given`: the setup as the user had
/// it. Throws Interrupted.
Report report_of(const Diagnosis& diagnosis, const Measurement& measurement, const Setup& given,
                 const PageOptions& page);

}  // namespace shakedown
