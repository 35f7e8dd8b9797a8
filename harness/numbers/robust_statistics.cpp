// SPDX-License-Identifier: MIT
#include "robust_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shakedown {

double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });  // it has no place in an order
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

double typical_interval(const std::vector<double>& ascending) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < ascending.size(); ++i) steps.push_back(ascending[i] - ascending[i - 1]);
  return median(std::move(steps));
}

double robust_deviation(const std::vector<double>& values) {
  const double centre = median(values);
  std::vector<double> deviations;
  deviations.reserve(values.size());
  for (const double value : values) deviations.push_back(std::abs(value - centre));
  return 1.482602218505602 * median(std::move(deviations));
}

}  // namespace shakedown
