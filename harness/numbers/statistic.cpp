// SPDX-License-Identifier: MIT
#include "statistic.hpp"

#include <cmath>

namespace shakedown {

Statistic statistic_of(std::span<const double> values) {
  Statistic statistic;
  double sum = 0;
  for (const double value : values)
    if (!std::isnan(value)) {
      sum += value;
      ++statistic.n;
    }
  if (statistic.n == 0) return statistic;
  statistic.mean = sum / statistic.n;
  double squares = 0;
  for (const double value : values)
    if (!std::isnan(value)) squares += (value - statistic.mean) * (value - statistic.mean);
  if (statistic.n > 1) statistic.sd = std::sqrt(squares / (statistic.n - 1));
  return statistic;
}

}  // namespace shakedown
