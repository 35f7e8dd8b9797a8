// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "trajectory.hpp"

namespace shakedown {

/// Measures how far energy or momentum is off balance, the same in every engine: the worst that was seen over
/// a scale that the release gives, or over the most that was ever held where forces put in more than that.
/// What went through a line of the ledger since the last look counts as held: a ball that falls from rest and
/// bounces may rest again at every look.
class OpenBook {
 public:
  /// Looks at the balance of one moment. `open`: what is there less what should be there; `held`: what is
  /// there, in the same unit, J or N s.
  void see(double open, double held) {
    worst_ = std::isfinite(open) ? std::max(worst_, std::abs(open)) : std::numeric_limits<double>::infinity();
    most_ = std::max(most_, std::abs(held));
  }
  /// Does the same for energy, J; the change of each line of the ledger since the last look counts as held
  /// too.
  void see(double open, double held, const Ledger& lines) {
    for (std::size_t c = 0; c < contact_classes; ++c)
      held = std::max(std::abs(held), std::abs(lines.contact_loss[c] - last_.contact_loss[c]));
    last_.effect_loss.resize(lines.effect_loss.size());
    for (std::size_t e = 0; e < lines.effect_loss.size(); ++e)
      held = std::max(std::abs(held), std::abs(lines.effect_loss[e] - last_.effect_loss[e]));
    last_ = lines;
    see(open, held);
  }
  /// Returns the worst `open` as a fraction of `scale`, or of the most that was held where that is more than
  /// `scale` by more than rounding; infinity where something is open and both are 0.
  double error(double scale) const {
    constexpr double rounding = 1e-6;
    return worst_ > 0 ? worst_ / (most_ > scale * (1 + rounding) ? most_ : scale) : 0;
  }

 private:
  double worst_ = 0, most_ = 0;
  Ledger last_;
};

}  // namespace shakedown
