// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace shakedown {

/// How far a book of energy or momentum stands open, the same in every engine: the worst that was seen over a
/// scale that the release gives, or over the most that the book ever held where forces put in more than that.
class OpenBook {
 public:
  void see(double open, double held) {
    worst_ = std::isfinite(open) ? std::max(worst_, std::abs(open)) : std::numeric_limits<double>::infinity();
    most_ = std::max(most_, std::abs(held));
  }
  /// The error as a fraction of `scale`, or of the most that was held; infinity where something is open and
  /// nothing was ever held. Rounding alone is no more than the release gave.
  double error(double scale) const {
    constexpr double rounding = 1e-6;
    return worst_ > 0 ? worst_ / (most_ > scale * (1 + rounding) ? most_ : scale) : 0;
  }

 private:
  double worst_ = 0, most_ = 0;
};

}  // namespace shakedown
