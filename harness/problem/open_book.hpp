// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "trajectory.hpp"

namespace shakedown {

/// How far a book of energy or momentum stands open, the same in every engine: the worst that was seen over a
/// scale that the release gives, or over the most that the book ever held where forces put in more than that.
/// What went through a line of the ledger since one last looked has been held: a ball that falls from rest
/// and bounces may rest again whenever one looks.
class OpenBook {
 public:
  void see(double open, double held) {
    worst_ = std::isfinite(open) ? std::max(worst_, std::abs(open)) : std::numeric_limits<double>::infinity();
    most_ = std::max(most_, std::abs(held));
  }
  void see(double open, double held, const Ledger& lines) {
    for (std::size_t c = 0; c < contact_classes; ++c)
      held = std::max(std::abs(held), std::abs(lines.contact_loss[c] - last_.contact_loss[c]));
    last_.effect_loss.resize(lines.effect_loss.size());
    for (std::size_t e = 0; e < lines.effect_loss.size(); ++e)
      held = std::max(std::abs(held), std::abs(lines.effect_loss[e] - last_.effect_loss[e]));
    last_ = lines;
    see(open, held);
  }
  /// The error as a fraction of `scale`, or of the most that was held; infinity where something is open and
  /// nothing was ever held. Rounding alone is no more than the release gave.
  double error(double scale) const {
    constexpr double rounding = 1e-6;
    return worst_ > 0 ? worst_ / (most_ > scale * (1 + rounding) ? most_ : scale) : 0;
  }

 private:
  double worst_ = 0, most_ = 0;
  Ledger last_;
};

}  // namespace shakedown
