// SPDX-License-Identifier: MIT
#include "track_drops.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "column_reading.hpp"
#include "drop_sequences.hpp"
#include "least_squares.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr std::size_t least_frames = 4;

/// One flight: height b + c s + a s^2, s the time from its middle.
struct Parabola {
  double middle = 0, b = 0, c = 0, a = 0, rms = 0, weight = 0;
  std::size_t first = 0, last = 0;  ///< frames used
};

/// Bends of the track over this time, s, tell an impact from the top of a flight.
constexpr double bend_time = 0.012;

/// Returns differences of second order over k frames on either side; the first and last k are 0.
std::vector<double> bends_of(const std::vector<double>& y, std::size_t k) {
  std::vector<double> bends(y.size(), 0);
  for (std::size_t i = k; i + k < y.size(); ++i) bends[i] = y[i + k] - 2 * y[i] + y[i - k];
  return bends;
}

std::size_t frames_of_a_bend(const std::vector<double>& t) {
  const double step = (t.back() - t.front()) / static_cast<double>(t.size() - 1),
               all = static_cast<double>(t.size());
  if (!(step > 0)) return t.size();  // no clock: no bend is seen
  return static_cast<std::size_t>(std::clamp(std::round(bend_time / step), 1.0, all));
}

/// Returns the frames in which the ball is lowest between falling and rising: where the track bends upwards
/// by more than noise does, and more than gravity bends it downwards.
std::vector<std::size_t> lowest_frames(const std::vector<double>& t, const std::vector<double>& y) {
  const std::size_t k = frames_of_a_bend(t);
  const std::vector<double> bends = bends_of(y, k);
  const double least = std::max(5 * robust_deviation(bends), 3 * std::abs(median(bends)));
  std::vector<std::size_t> found;
  for (std::size_t i = k; i + k < y.size(); ++i) {
    const auto at = [&](std::size_t j) { return bends.begin() + static_cast<std::ptrdiff_t>(j); };
    if (bends[i] < least || std::max_element(at(i - k), at(i + k + 1)) != at(i)) continue;
    const auto low = std::min_element(y.begin() + static_cast<std::ptrdiff_t>(i - k),
                                      y.begin() + static_cast<std::ptrdiff_t>(i + k + 1));
    const std::size_t lowest = static_cast<std::size_t>(low - y.begin());
    if (found.empty() || lowest > found.back() + 1) found.push_back(lowest);
  }
  return found;
}

Parabola parabola(const std::vector<double>& t, const std::vector<double>& y, std::size_t first,
                  std::size_t last, double curvature) {
  const Eigen::Index count = static_cast<Eigen::Index>(last - first + 1);
  const bool fixed = std::isfinite(curvature);
  Parabola fit;
  fit.first = first, fit.last = last;
  fit.middle = (t[first] + t[last]) / 2;
  Eigen::MatrixXd columns(count, fixed ? 2 : 3);
  Eigen::VectorXd values(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double s = t[first + static_cast<std::size_t>(i)] - fit.middle;
    columns(i, 0) = 1, columns(i, 1) = s;
    if (!fixed) columns(i, 2) = s * s;
    values[i] = y[first + static_cast<std::size_t>(i)] - (fixed ? curvature * s * s : 0);
  }
  const LeastSquares found = least_squares(columns, values);
  fit.b = found.coefficients[0], fit.c = found.coefficients[1];
  fit.a = fixed ? curvature : found.coefficients[2];
  fit.rms = found.rms;
  fit.weight = static_cast<double>(count) * std::pow(t[last] - t[first], 4);
  return fit;
}

/// Returns the time at which two parabolas of one curvature cross.
double crossing(const Parabola& before, const Parabola& after) {
  // b + c (t - m) + a (t - m)^2 of both, in the time from the middle between them
  const double origin = (before.middle + after.middle) / 2;
  const auto at_origin = [&](const Parabola& p) {
    const double s = origin - p.middle;
    return std::pair{p.b + p.c * s + p.a * s * s, p.c + 2 * p.a * s};
  };
  const auto [b1, c1] = at_origin(before);
  const auto [b2, c2] = at_origin(after);
  return origin + (b1 - b2) / (c2 - c1);
}

double weighted_median(std::vector<std::pair<double, double>> values) {
  std::sort(values.begin(), values.end());
  double all = 0, sum = 0;
  for (const auto& [value, weight] : values) all += weight;
  for (const auto& [value, weight] : values)
    if ((sum += weight) >= all / 2) return value;
  return not_said;
}

/// Returns first frame and end of each flight: frames that hold an impact are left out.
std::vector<std::pair<std::size_t, std::size_t>> flights_between(const std::vector<std::size_t>& lowest,
                                                                 std::size_t frames) {
  std::vector<std::pair<std::size_t, std::size_t>> flights;
  for (std::size_t k = 0; k <= lowest.size(); ++k) {
    const std::size_t first = k == 0 ? 0 : lowest[k - 1] + 1;
    const std::size_t end = k == lowest.size() ? frames : lowest[k];
    flights.push_back({first, end});
  }
  return flights;
}

double clock_size(const Table& table, const TableColumn& column, const DropReading& reading) {
  if (reading.rate > 0) return 1 / reading.rate;
  std::string unit = reading.unit.empty() ? column.unit : reading.unit;
  if (unit.empty()) unit = unit_in_name(column.name);
  if (const std::optional<double> size = unit_size(unit, true, {}); size) return *size;
  const double step = (column.value.back() - column.value.front()) / static_cast<double>(column.value.size());
  if (step < 0.2) return 1;
  if (column.value[0] != std::round(column.value[0]) || step > 1.5) return 1e-3;
  throw InputError({{{table.file, 1, 1},
                     column.name,
                     "counts frames, and how many a second is not said",
                     "give --rate, e.g. --rate \"240 Hz\""}});
}

}  // namespace

TrackImpacts impacts_of_track(std::vector<double> t, std::vector<double> y, double gravity) {
  if (t.size() < least_frames) return {};
  if (median(bends_of(y, frames_of_a_bend(t))) >
      0)  // pixels are counted downwards: in flight the curve bends down
    for (double& one : y) one = -one;
  const std::vector<std::size_t> lowest = lowest_frames(t, y);
  const auto flights = flights_between(lowest, y.size());
  std::vector<std::pair<double, double>> curvatures;
  for (std::size_t k = 1; k + 1 < flights.size(); ++k)
    if (flights[k].second >= flights[k].first + least_frames) {
      const Parabola one = parabola(t, y, flights[k].first, flights[k].second - 1, not_said);
      if (one.a < 0) curvatures.push_back({one.a, one.weight});
    }
  TrackImpacts found;
  if (curvatures.empty()) return found;
  const double curvature = weighted_median(curvatures);
  found.scale = gravity / (-2 * curvature);
  std::vector<double> rms;
  Parabola last;
  for (std::size_t k = 0; k < flights.size(); ++k) {
    if (flights[k].second < flights[k].first + least_frames) {
      if (k > 0) break;
      continue;
    }
    const Parabola one = parabola(t, y, flights[k].first, flights[k].second - 1, curvature);
    if (last.weight > 0) found.instant.push_back(crossing(last, one));
    if (k == 0 && !lowest.empty()) {
      const double top = one.middle - one.c / (2 * one.a);
      // from rest: the highest point is in the track, or the track begins with it
      if (top >= t.front() - 2 * (t[1] - t[0])) found.fall = -top;
    }
    rms.push_back(one.rms);
    last = one;
  }
  if (std::isfinite(found.fall)) found.fall += found.instant.empty() ? not_said : found.instant.front();
  found.deviation = median(rms);
  return found;
}

ReadDrops drops_of_track(const Table& table, const TrackColumns& columns, const DropReading& reading) {
  if (!columns.time || !columns.height)
    throw InputError(
        {{{table.file, 1, 1}, "--column", "names a column that is not there", "see its header"}});
  const double size = clock_size(table, *columns.time, reading);
  std::vector<double> t, y;
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (std::isfinite(columns.time->value[i]) && std::isfinite(columns.height->value[i]))
      t.push_back(columns.time->value[i] * size), y.push_back(columns.height->value[i]);
  const TrackImpacts impacts = impacts_of_track(t, y, reading.gravity);
  if (impacts.instant.size() < 3)
    throw InputError(
        {{{table.file, 1, 1},
          "",
          fmt::format("shows {} impacts with four frames of flight on either side", impacts.instant.size()),
          "three are needed: film with more frames a second, or for longer"}});
  ReadDrops read;
  read.drops = drops_of_instants(impacts.instant, "");
  if (read.drops.empty())
    throw InputError({{{table.file, 1, 1},
                       columns.height->name,
                       "gives flights whose parabolas cross at no instant that is a number",
                       "give the heights in another unit, e.g. in metres"}});
  for (Drop& drop : read.drops) drop.file = table.file, drop.height = reading.height;
  Drop& first = read.drops.front();
  if (std::isfinite(impacts.fall) && !std::isfinite(reading.height) && impacts.fall > 0) {
    first.interval.insert(first.interval.begin(), 2 * impacts.fall);
    first.impact.insert(first.impact.begin(), 0);
    first.stated_height = reading.gravity * impacts.fall * impacts.fall / 2;
  }
  read.notes.push_back(fmt::format(
      "{}: track of a ball, columns '{}' and '{}'; {} impacts; one unit of height is {:.4g} m by gravity; a "
      "frame lies {:.2g} of it from its parabola",
      table.file, columns.time->name, columns.height->name, impacts.instant.size(), impacts.scale,
      impacts.deviation));
  if (std::isfinite(first.stated_height))
    read.notes.push_back(fmt::format("{}: fell from {:.3f} m above the floor by its first parabola",
                                     table.file, first.stated_height));
  return read;
}

}  // namespace shakedown
