// SPDX-License-Identifier: MIT
// Gives the price of a term beside formulas that no list has, where no prior of a strength can be written
// down: a parameter costs ln n (Schwarz's criterion), a term six more, about 4e-4 false alarms.
#pragma once
#include <optional>

#include "balance_evidence.hpp"

namespace shakedown {

constexpr double price_of_a_term = 6;

/// Holds the known strength that is most worth adding, and its gain less its price.
struct KnownCandidate {
  ChosenTerm term;
  double surplus = 0;
};
/// Returns the best of the known strengths that are not chosen yet; nothing where none gains.
std::optional<KnownCandidate> best_known(const SelectionProblem& p, const Selection& selection);

/// Drops the first term that is no longer worth its price; returns false when there is none.
bool drop_needless(SelectionProblem& p, Selection& selection);

}  // namespace shakedown
