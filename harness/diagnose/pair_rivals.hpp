// SPDX-License-Identifier: MIT
// Weighs two effects at once, where each alone explains little, so that neither would be found beside the
// other.
#pragma once
#include <string>
#include <vector>

#include "rival.hpp"

namespace shakedown {

/// Carries a pair of candidates through a round of the search.
struct PairRival {
  Rival first, second;      ///< of `second` the state and the log ratio are those of both
  double log_evidence = 0;  ///< of their signatures, as ScreenedPair's
  double log_odds = 0;      ///< beside nothing
  bool fitted = false;      ///< and weighed by that

  /// Return the names of both effects, and "first and second".
  std::vector<std::string> effects() const { return {first.candidate->effect, second.candidate->effect}; }
  std::string words() const { return first.candidate->effect + " and " + second.candidate->effect; }
};

/// Returns the pairs that their signatures make more probable than any single rival is by its own, most
/// probable first. Left out are pairs of look-alikes: beside the one the next round asks for the other.
/// `searched`: the number of effects that are looked for.
std::vector<PairRival> pairs_beyond(const std::vector<Rival>& rivals, const std::vector<ScreenedPair>& pairs,
                                    const std::vector<Candidate>& candidates, double searched);

/// Tells whether its signatures make it more probable than any single rival by more than signatures err.
bool is_far_beyond(const PairRival& pair, const std::vector<Rival>& rivals);

/// Fits both beside the state `before`, as fit_rival does with one.
void fit_pair(PairRival& pair, const DiagnosisState& before, DiagnosisTools& tools, EffectScreen& screen,
              double lowest, Effort effort);

/// Sets the odds of a pair by its fit, as weigh_rival does those of one; what was not fitted keeps its own.
/// `searched` as for pairs_beyond.
void weigh_pair(PairRival& pair, double searched);

}  // namespace shakedown
