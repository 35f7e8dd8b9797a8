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

struct Usual {
  double ratio = 0, deviation = 0;
  bool far(double ratio_seen) const {
    return std::abs(ratio_seen / ratio - 1) > std::max(gross, 8 * deviation / ratio);
  }
};

/// Of the ratios in one drop, or of all where a drop has few.
Usual usual_ratio(const std::vector<Drop>& drops) {
  std::vector<double> ratios;
  for (const Drop& drop : drops)
    for (std::size_t i = 1; i < drop.interval.size(); ++i)
      ratios.push_back(drop.interval[i] / drop.interval[i - 1]);
  if (ratios.size() < 3) return {};
  return {median(ratios), robust_deviation(ratios)};
}

bool cut_at(const std::vector<Outlier>& outliers, std::size_t drop, int impact, OutlierKind kind) {
  return std::any_of(outliers.begin(), outliers.end(), [&](const Outlier& outlier) {
    return outlier.drop == drop && outlier.impact == impact && outlier.kind == kind;
  });
}

/// The ratio that this interval has to what its neighbours foretell of it; NaN without any.
double to_foretold(const Drop& drop, std::size_t i, double ratio) {
  std::vector<double> foretold;
  if (i > 0) foretold.push_back(drop.interval[i - 1] * ratio);
  if (i + 1 < drop.interval.size()) foretold.push_back(drop.interval[i + 1] / ratio);
  return foretold.empty() ? not_said : drop.interval[i] / median(foretold);
}

/// An interval that holds two flights: it is as long as one and its follower.
bool holds_two(const Drop& drop, std::size_t i, const Usual& usual) {
  const double e = usual.ratio, two = 1 + e;
  const bool before = i == 0 || !usual.far(drop.interval[i] / (drop.interval[i - 1] * two));
  const bool after =
      i + 1 == drop.interval.size() || !usual.far(drop.interval[i + 1] * two / (drop.interval[i] * e));
  return before && after && drop.interval.size() > 1;
}

/// Two intervals that are one flight.
bool are_one(const Drop& drop, std::size_t i, const Usual& usual) {
  if (i + 1 >= drop.interval.size() || drop.interval.size() < 3) return false;
  const double sum = drop.interval[i] + drop.interval[i + 1];
  const bool before = i == 0 || !usual.far(sum / drop.interval[i - 1]);
  const bool after = i + 2 >= drop.interval.size() || !usual.far(drop.interval[i + 2] / sum);
  return before && after && (i > 0 || i + 2 < drop.interval.size()) &&
         usual.far(drop.interval[i + 1] / drop.interval[i]);
}

}  // namespace

std::vector<Outlier> gross_outliers(const std::vector<Drop>& drops) {
  std::vector<Outlier> found;
  const Usual usual = usual_ratio(drops);
  if (!(usual.ratio > 0)) return found;
  for (std::size_t d = 0; d < drops.size(); ++d) {
    const Drop& drop = drops[d];
    for (std::size_t i = 0; i < drop.interval.size(); ++i) {
      const double foretold = to_foretold(drop, i, usual.ratio);
      if (std::isfinite(foretold) && foretold > 1.3 && holds_two(drop, i, usual)) {
        found.push_back({d, drop.impact[i], OutlierKind::missed, drop.interval[i],
                         drop.interval[i] / foretold, 0, "an impact was missed: the interval holds two"});
      } else if (are_one(drop, i, usual)) {
        found.push_back({d, drop.impact[i + 1], OutlierKind::extra, drop.interval[i], not_said, 0,
                         "an instant too many: it parts one flight in two"});
        ++i;
      } else if (i > 0 && usual.far(drop.interval[i] / drop.interval[i - 1]) &&
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
