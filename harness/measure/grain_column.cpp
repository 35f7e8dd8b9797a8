// SPDX-License-Identifier: MIT
#include "grain_column.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "quantity.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

/// Scales and origins of a camera move the centre by some per cent of its way; what is beyond this is no
/// error of a camera.
constexpr double beyond = 1.5;    // halves of the box
constexpr double too_many = 0.1;  // of the frames

/// The change of x_com to `factor` x_com + `shift` (m).
struct Change {
  double factor = 1, shift = 0;
};

double share_outside(const std::vector<double>& x_box, const std::vector<double>& x_com, double length,
                     const Change& change) {
  double outside = 0, count = 0;
  for (std::size_t i = 0; i < x_box.size() && i < x_com.size(); ++i) {
    const double apart = change.factor * x_com[i] + change.shift - x_box[i];
    if (!std::isfinite(apart)) continue;
    ++count;
    outside += std::abs(apart) > beyond * length / 2;
  }
  return count > 0 ? outside / count : 0;
}

double median_apart(const std::vector<double>& x_box, const std::vector<double>& x_com) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < x_box.size() && i < x_com.size(); ++i)
    if (std::isfinite(x_com[i] - x_box[i])) apart.push_back(x_com[i] - x_box[i]);
  return apart.empty() ? 0 : median(apart);
}

double range_of(const std::vector<double>& x) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : x)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  return high > low ? high - low : 0;
}

std::string short_mm(double metres) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", metres);
  return write_quantity(std::strtod(digits, nullptr), "mm");
}

struct Remedy {
  double factor;
  const char* words;
};

}  // namespace

std::optional<Problem> problem_of_grains(const std::vector<double>& x_box, const std::vector<double>& x_com,
                                         double length) {
  if (!(length > 0)) return std::nullopt;
  const auto fits = [&](const Change& change) {
    return share_outside(x_box, x_com, length, change) < too_many;
  };
  constexpr double hardly = 0.02;  // of the box's way
  if (range_of(x_com) < hardly * range_of(x_box))
    return Problem{"stands still while the box swings by " + short_mm(range_of(x_box)),
                   "choose the column of the grains, or write column.grain_centre.from = \"\" to do without"};
  if (fits({})) return std::nullopt;
  char share[32];
  std::snprintf(share, sizeof share, "%.0f", 100 * share_outside(x_box, x_com, length, {}));
  const std::string found = "in " + std::string(share) +
                            " % of the frames the grains' centre lies outside of the box (" +
                            short_mm(length) + " long)";
  constexpr std::array<Remedy, 6> units{
      {{1e-3, "it is in another unit: write unit = \"mm\" where it says m"},
       {1e-2,
        "it is in another unit: write unit = \"mm\" where it says dm, or "
        "\"cm\" where it says m"},
       {1e-1, "it is in another unit: write unit = \"mm\" where it says cm"},
       {10, "it is in another unit: write unit = \"cm\" where it says mm"},
       {100, "it is in another unit: write unit = \"m\" where it says cm"},
       {1000, "it is in another unit: write unit = \"m\" where it says mm"}}};
  if (fits({-1, 0}))
    return Problem{found,
                   "it is counted to the other side: write reversed = true in [column.grain_centre] (or in "
                   "[column.box_position], if the box is released to the negative side)"};
  for (const Remedy& unit : units)
    if (fits({unit.factor, 0})) return Problem{found, std::string(unit.words) + " in [column.grain_centre]"};
  if (const double shift = median_apart(x_box, x_com); fits({1, -shift}))
    return Problem{found,
                   "it is counted from elsewhere than the box: move the origin of [column.grain_centre] by " +
                       short_mm(shift)};
  return Problem{found,
                 "look whether this is the column of the grains, and at its unit and origin; write "
                 "column.grain_centre.from = \"\" to do without, or correct box_length"};
}

}  // namespace shakedown
