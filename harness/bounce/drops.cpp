// SPDX-License-Identifier: MIT
#include "drops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "robust_statistics.hpp"

namespace shakedown {

namespace {

/// Ratios of neighbouring intervals differ from the usual one by less than this share unless something is
/// wrong that is no matter of noise: an edge that was hit, an impact that was not heard.
constexpr double gross = 0.14;
constexpr double longer_than_one = 1.3;

struct Usual {
  double ratio = 0, deviation = 0;  ///< of intervals to those before
  double absolute = 0;              ///< s, deviation of an interval from what that ratio foretells
  bool far(double seen, double foretold) const {
    const double off = std::abs(seen - foretold);
    return off > std::max(gross, 8 * deviation / ratio) * foretold && off > 8 * absolute;
  }
};

/// Returns the usual ratio over all pairs of neighbours; zeros from fewer than three.
Usual usual_ratio(const std::vector<Drop>& drops) {
  std::vector<double> ratios, off;
  const auto each_pair = [&](const auto& take) {
    for (const Drop& drop : drops)
      for (std::size_t i = 1; i < drop.interval.size(); ++i) take(drop.interval[i - 1], drop.interval[i]);
  };
  each_pair([&](double before, double after) { ratios.push_back(after / before); });
  if (ratios.size() < 3) return {};
  const double ratio = median(ratios);
  each_pair([&](double before, double after) { off.push_back(after - ratio * before); });
  return {ratio, robust_deviation(ratios), robust_deviation(off)};
}

bool cut_at(const std::vector<Outlier>& outliers, std::size_t drop, int impact, OutlierKind kind) {
  return std::any_of(outliers.begin(), outliers.end(), [&](const Outlier& outlier) {
    return outlier.drop == drop && outlier.impact == impact && outlier.kind == kind;
  });
}

/// Returns what its neighbours foretell of this interval, s; NaN without any.
double foretold_by_neighbours(const Drop& drop, std::size_t i, double ratio) {
  std::vector<double> foretold;
  if (i > 0) foretold.push_back(drop.interval[i - 1] * ratio);
  if (i + 1 < drop.interval.size()) foretold.push_back(drop.interval[i + 1] / ratio);
  return foretold.empty() ? not_said : median(foretold);
}

/// Tells whether an interval holds two flights: it is as long as one and its follower.
bool holds_two(const Drop& drop, std::size_t i, const Usual& usual) {
  const auto& x = drop.interval;
  const double e = usual.ratio, foretold = foretold_by_neighbours(drop, i, e);
  if (!std::isfinite(foretold) || x[i] < longer_than_one * foretold || !usual.far(x[i], foretold))
    return false;
  const bool before = i == 0 || !usual.far(x[i], x[i - 1] * e * (1 + e));
  const bool after = i + 1 == x.size() || !usual.far(x[i + 1], x[i] * e * e / (1 + e));
  return before && after;
}

/// Tells whether interval i and the next are one flight.
bool are_one(const Drop& drop, std::size_t i, const Usual& usual) {
  const auto& x = drop.interval;
  if (i + 1 >= x.size() || x.size() < 3 || !usual.far(x[i + 1], x[i] * usual.ratio)) return false;
  const double sum = x[i] + x[i + 1];
  const bool before = i == 0 || !usual.far(sum, x[i - 1] * usual.ratio);
  const bool after = i + 2 >= x.size() || !usual.far(x[i + 2], sum * usual.ratio);
  return before && after && (i > 0 || i + 2 < x.size());
}

}  // namespace

std::vector<Outlier> gross_outliers(const std::vector<Drop>& drops) {
  std::vector<Outlier> found;
  const Usual usual = usual_ratio(drops);
  if (!(usual.ratio > 0)) return found;
  for (std::size_t d = 0; d < drops.size(); ++d) {
    const Drop& drop = drops[d];
    for (std::size_t i = 0; i < drop.interval.size(); ++i) {
      if (holds_two(drop, i, usual)) {
        found.push_back({d, drop.impact[i], OutlierKind::missed, drop.interval[i],
                         foretold_by_neighbours(drop, i, usual.ratio), 0,
                         "an impact was missed: the interval holds two"});
      } else if (are_one(drop, i, usual)) {
        found.push_back({d, drop.impact[i + 1], OutlierKind::extra, drop.interval[i], not_said, 0,
                         "an instant too many: it parts one flight in two"});
        ++i;
      } else if (i > 0 && usual.far(drop.interval[i], drop.interval[i - 1] * usual.ratio) &&
                 !cut_at(found, d, drop.impact[i - 1], OutlierKind::missed) &&
                 !cut_at(found, d, drop.impact[i - 1], OutlierKind::extra)) {
        const double e = drop.interval[i] / drop.interval[i - 1];
        found.push_back({d, drop.impact[i], OutlierKind::impact, e, usual.ratio, 0,
                         e < usual.ratio ? "lost far more speed than its like: an edge was hit?"
                                         : "lost far less speed than its like: a wrong instant beside it?"});
      }
    }
  }
  return found;
}

std::vector<Flights> usable_flights(const std::vector<Drop>& drops, const std::vector<Outlier>& outliers) {
  std::vector<Flights> all;
  for (std::size_t d = 0; d < drops.size(); ++d) {
    const Drop& drop = drops[d];
    const auto is = [&](int impact, OutlierKind kind) { return cut_at(outliers, d, impact, kind); };
    Flights now{d, {}, {}, drop.height};
    const auto cut = [&] {
      if (!now.interval.empty()) all.push_back(now);
      now = Flights{d, {}, {}, not_said};
    };
    for (std::size_t i = 0; i < drop.interval.size(); ++i) {
      const int impact = drop.impact[i], next = impact + 1;
      double interval = drop.interval[i];
      if (is(impact, OutlierKind::missed) || is(impact, OutlierKind::instant) ||
          is(next, OutlierKind::instant)) {
        cut();
        continue;
      }
      if (is(impact, OutlierKind::impact)) cut();
      if (is(next, OutlierKind::extra) && i + 1 < drop.interval.size()) interval += drop.interval[++i];
      now.interval.push_back(interval);
      now.impact.push_back(impact);
    }
    cut();
  }
  std::erase_if(all, [](const Flights& flights) {
    return flights.interval.size() + (std::isfinite(flights.height) ? 1 : 0) < 2;
  });
  return all;
}

}  // namespace shakedown
