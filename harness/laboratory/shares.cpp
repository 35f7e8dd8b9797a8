// SPDX-License-Identifier: MIT
#include "shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "distributions.hpp"

namespace shakedown {

Share share_of(int hits, int trials) {
  if (trials == 0) return {};
  constexpr double z = normal_95;
  const double n = trials, p = hits / n, wide = 1 + z * z / n;
  const double middle = (p + z * z / (2 * n)) / wide,
               half = z * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / wide;
  return {hits, trials, p, hits == 0 ? 0 : middle - half, hits == trials ? 1 : middle + half};
}

std::string in_words(const Share& share) {
  return fmt::format("{} of {} ({:.0f} %, 95 %: {:.0f} to {:.0f} %)", share.hits, share.trials,
                     100 * share.value, 100 * share.low, 100 * share.high);
}

double uniformity_p_value(std::vector<double> values) {
  if (values.empty()) return 1;
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  double distance = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    distance = std::max(
        {distance, values[i] - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - values[i]});
  const double t = distance * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));
  if (t < 0.2) return 1;  // below, the series converges too slowly and the sum is 1 to 1e-12
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 == 1 ? 2 : -2) * std::exp(-2.0 * k * k * t * t);
  return std::clamp(sum, 0.0, 1.0);
}

}  // namespace shakedown
