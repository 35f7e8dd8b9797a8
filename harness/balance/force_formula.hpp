// SPDX-License-Identifier: MIT
// Finds a formula that closes the momentum balance where no effect of the library does, and which others
// would do as well.
#pragma once
#include <string>
#include <vector>

#include "balance_evidence.hpp"
#include "force_map.hpp"

namespace shakedown {

/// Holds the balance explained with formulas among its terms.
struct FormulaFit {
  Selection selection;  ///< lines of `problem.terms` beyond the known ones are formulas
  SelectionProblem problem;
  std::vector<ForceFormula> formulas;  ///< in the order of the selection
  std::vector<ForceCurve>
      curves;       ///< what the known terms leave, as curves of position, velocity and time, best first
  double cost = 0;  ///< chi2 plus the price of each term; smaller is better
};

/// Selects forward, over known terms and formulas together. A formula costs more than a known term, and its
/// shape parameters too.
FormulaFit fit_formulas(SelectionProblem problem);

/// Returns for each term of a selection the formulas without shape parameters that would do as well in its
/// place, chi2 at most as_good higher.
std::vector<std::vector<std::string>> formulas_like_known_terms(const SelectionProblem& problem,
                                                                const Selection& selection);

/// Returns chi2 plus prices of a selection, to be compared with FormulaFit::cost.
double cost_of(const SelectionProblem& problem, const Selection& selection);

}  // namespace shakedown
