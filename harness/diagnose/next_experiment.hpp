// SPDX-License-Identifier: MIT
// Which experiment would tell two suspects apart: other box lengths, numbers of grains, releases are
// simulated with both effects scattered, and the one is told by how far its signature stands out of what the
// other and refitted parameters can imitate.
#pragma once
#include <string>
#include <vector>

#include "candidates.hpp"

namespace shakedown {

struct Design {
  std::string words;  ///< e.g. "N = 60, L = 65 mm"
  Setup setup;
};

/// Designs that need no other apparatus: the setup with other numbers of grains, box lengths and releases.
std::vector<Design> possible_designs(const Setup& setup);

struct Advice {
  std::string words;
  double sigmas = 0;  ///< of the found effect at its fitted strength beside the rival, one run of the design
};

/// The found effect's knobs (at their fitted values in `found`) against the rival's; `parameters` are
/// refitted. One entry a design, best first. `noise_box`, `noise_centre`: of a frame, m. Linear in the
/// strengths.
std::vector<Advice> advise(const std::vector<Design>& designs, const std::vector<Knob>& parameters,
                           const std::vector<Knob>& found, const Candidate& rival, double noise_box,
                           double noise_centre, const Workshop& workshop, int count, int first_run);

}  // namespace shakedown
