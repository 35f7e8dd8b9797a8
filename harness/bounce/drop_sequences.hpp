// SPDX-License-Identifier: MIT
// Drops in a series of intervals or instants.
#pragma once
#include <string>
#include <vector>

#include "drops.hpp"

namespace shakedown {

/// Cuts intervals (s) of one column or row into drops: a new one begins where intervals grow and then fall
/// again as before; of a series that is `labelled` as one drop only where the first interval comes again. A
/// first interval that is no flight (a fall from rest, half a flight) is left out. `name` stands before a
/// number where there are several.
std::vector<Drop> drops_of_intervals(const std::vector<double>& interval, const std::string& name,
                                     bool labelled = false);
/// Does the same with instants (s); pauses between drops are left out.
std::vector<Drop> drops_of_instants(const std::vector<double>& instant, const std::string& name,
                                    bool labelled = false);

}  // namespace shakedown
