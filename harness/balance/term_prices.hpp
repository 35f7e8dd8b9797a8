// SPDX-License-Identifier: MIT
// The price of a term beside formulas that no list has, where no prior of a strength can be written down: a
// parameter costs ln n (Schwarz's criterion), a term six more, about 4e-4 false alarms.
#pragma once
#include <optional>

#include "balance_evidence.hpp"

namespace shakedown {

constexpr double price_of_a_term = 6;

/// The known strength or sine that is most worth adding: its gain less its price.
struct KnownCandidate {
  ChosenTerm term;
  double surplus = 0;
};
std::optional<KnownCandidate> best_known(const SelectionProblem& p, const Selection& selection);

/// Drops the first term that is no longer worth its price; false when there is none.
bool drop_needless(SelectionProblem& p, Selection& selection);

}  // namespace shakedown
