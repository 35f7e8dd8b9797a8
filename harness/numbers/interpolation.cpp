// SPDX-License-Identifier: MIT
#include "interpolation.hpp"

#include <algorithm>
#include <limits>

#include "expect.hpp"

namespace shakedown {

double interpolated(std::span<const double> places, std::span<const double> values, double x) {
  EXPECT(places.size() == values.size());
  if (places.empty() || !(x >= places.front() && x <= places.back()))
    return std::numeric_limits<double>::quiet_NaN();
  const auto after = std::upper_bound(places.begin(), places.end(), x);
  if (after == places.end()) return values.back();
  const auto i = static_cast<std::size_t>(after - places.begin()) - 1;
  return values[i] + (values[i + 1] - values[i]) * (x - places[i]) / (places[i + 1] - places[i]);
}

}  // namespace shakedown
