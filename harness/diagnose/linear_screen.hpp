// SPDX-License-Identifier: MIT
// Which effects are worth trying: all candidates scattered at once about the fitted model, one regression,
// and for each the fall of chi2 when it joins with the fitted parameters free. Linear in the strengths, so
// only a ranking.
#pragma once
#include <string>
#include <vector>

#include "candidates.hpp"

namespace shakedown {

struct ScreenedEffect {
  std::size_t candidate = 0;  ///< index among the candidates
  std::string effect;
  double gain = 0;    ///< of chi2
  double value = 0;   ///< linear estimate of the parameter, SI
  StrengthSeen seen;  ///< the strength from its absence, with its error and prior
  std::vector<std::string>
      look_alikes;  ///< candidates whose signature after refitting has a cosine above 0.9 with its own
};

/// Best first. Candidates without knobs (on or off, with a length) get the gain along their difference at
/// whatever curvature, and that length.
std::vector<ScreenedEffect> screen(const std::vector<MeasuredFeatures>& measured,
                                   const std::vector<Knob>& fitted, const std::vector<Candidate>& candidates,
                                   const Workshop& workshop, int count, int first_run);

}  // namespace shakedown
