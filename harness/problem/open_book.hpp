// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace shakedown {

/// How far a book of energy or momentum stands open, the same in every engine: the worst that was seen over a
/// scale that the release gives; where it gives none (a box at rest where its spring is relaxed) over the
/// most that the book ever held.
class OpenBook {
 public:
  void see(double open, double held) {
    worst_ = std::isfinite(open) ? std::max(worst_, std::abs(open)) : std::numeric_limits<double>::infinity();
    most_ = std::max(most_, std::abs(held));
  }
  /// The error as a fraction of `scale`; infinity where something is open and nothing was ever held.
  double error(double scale) const { return worst_ > 0 ? worst_ / (scale > 0 ? scale : most_) : 0; }

 private:
  double worst_ = 0, most_ = 0;
};

}  // namespace shakedown
