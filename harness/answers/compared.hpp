// SPDX-License-Identifier: MIT
// Tells whether the model is acceptable for these measurements, and where it fails. Nothing is fitted but
// camera, clock and what two codes of one physics differ by.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "decay_comparison.hpp"
#include "engine.hpp"
#include "execution.hpp"
#include "judgement.hpp"
#include "last_fit.hpp"
#include "momentum.hpp"
#include "refit_result.hpp"
#include "report.hpp"

namespace shakedown {

/// Says how much is simulated.
struct CompareOptions {
  int runs = 128;  ///< simulations of each different setup
  Execution execution{};
  std::function<void(double fraction)> progress{};  ///< may be empty
};

/// Holds all that a comparison says.
struct Compared {
  Measurement measurement;              ///< from the first turn of each run on
  std::vector<std::string> warnings;    ///< what the frames as recorded give reason to say
  std::vector<std::string> notes;       ///< the same, and what was assumed in reading
  Refit fit;                            ///< of what is known to an error alone
  std::vector<DecayComparison> decays;  ///< of each run
  MomentumAudit momentum;
  ModelJudgement judgement;
  LastFit last;  ///< for the curves, and for what a reader may turn
};

/// Compares a setup with its measurement, `recorded`. Throws InputError where the engine does not model the
/// setup, Interrupted.
Compared compared_with(const Setup& setup, const Measurement& recorded, const Engine& engine,
                       const CompareOptions& options);

/// Returns the comparison as text for a terminal.
std::string compared_text(const Compared& compared);
/// Returns it as JSON text (harness/README.md).
std::string compared_json(const Compared& compared);

/// Returns the page; its curves and what its knobs do are simulated here. Throws Interrupted.
Report report_of(const Compared& compared, const Setup& setup, const Engine& engine,
                 const Execution& execution);

}  // namespace shakedown
