// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include "statistic.hpp"

namespace shakedown {

/// statistic_of() for values that come one at a time and are not kept (B. P. Welford, Technometrics 4, 419
/// (1962)). NaN counts as absent.
class RunningStatistic {
 public:
  /// Takes one more value, unless it is NaN.
  void add(double value) {
    if (std::isnan(value)) return;
    const double step = value - mean_;
    mean_ += step / ++n_;
    squares_ += step * (value - mean_);
  }
  /// Returns mean, standard deviation (n - 1) and number; NaN for a mean of none and a deviation of fewer
  /// than two.
  Statistic statistic() const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {n_ > 0 ? mean_ : none, n_ > 1 ? std::sqrt(squares_ / (n_ - 1)) : none, n_};
  }

 private:
  double mean_ = 0, squares_ = 0;
  int n_ = 0;
};

}  // namespace shakedown
