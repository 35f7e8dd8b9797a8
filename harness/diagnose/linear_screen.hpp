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
      look_alikes;      ///< candidates whose signature after refitting has a cosine above 0.9 with its own
  bool weighed = true;  ///< false: not looked at, for only a fit at full strength would tell
};

struct Screening {
  std::vector<ScreenedEffect> list;  ///< best first
  struct LeftOut {
    std::string effect, reason;
  };
  std::vector<LeftOut> left_out;  ///< candidates that the engine could not simulate
};

/// Candidates without knobs (on or off, with a length) get the gain along their difference at whatever
/// curvature, and that length. `metric`: covariance of each measured run's features, m^2, by which the fit of
/// the model without them was judged, so that gains here and there are one thing; empty: of these
/// simulations. `first_run` addresses the random numbers.
Screening screen(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                 const std::vector<Candidate>& candidates, const Workshop& workshop, int count, int first_run,
                 const std::vector<Eigen::MatrixXd>& metric = {});

}  // namespace shakedown
