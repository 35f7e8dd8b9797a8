// SPDX-License-Identifier: MIT
#include "release_found.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "least_squares.hpp"
#include "nothing.hpp"
#include "robust_statistics.hpp"
#include "slow_wander.hpp"

namespace shakedown {

namespace {

constexpr double first_moments =
    0.06;                          // s, in which a parabola describes the start of a damper of about 1 Hz
constexpr std::size_t fewest = 6;  // frames of a fit
constexpr std::size_t fewest_at_rest = 5;
constexpr double surely_off = 5;  // standard deviations

struct Level {
  double value = nothing, error = nothing, frames = 0;
};

Level level_of(const std::vector<double>& x, std::size_t first, std::size_t end, double deviation) {
  std::vector<double> kept;
  for (std::size_t i = first; i < end; ++i)
    if (std::isfinite(x[i])) kept.push_back(x[i]);
  if (kept.empty()) return {};
  // Medians scatter sqrt(pi / 2) times as much as means.
  const auto frames = static_cast<double>(kept.size());
  return {median(kept), deviation * std::sqrt(std::numbers::pi / 2 / frames), frames};
}

/// Returns the first of three frames in a row that are surely off the level; x.size() where there are none.
std::size_t leaves(const std::vector<double>& x, const Level& level, double sure) {
  int row = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i])) continue;
    row = std::abs(x[i] - level.value) > sure ? row + 1 : 0;
    if (row == 3) return i - 2;
  }
  return x.size();
}

/// Sets the start to where sqrt|x - level| = 0 on a line through the first tenth of the range, as x - level =
/// a (t - start)^2 / 2.
void extrapolate_start(const std::vector<double>& time, const std::vector<double>& x, std::size_t first,
                       const Level& level, double range, ReleaseFound& found) {
  std::vector<double> t, root;
  for (std::size_t i = first; i < x.size() && t.size() < 200; ++i) {
    const double off = std::abs(x[i] - level.value);
    if (off > 0.1 * range) break;
    if (std::isfinite(off)) t.push_back(time[i] - time[first]), root.push_back(std::sqrt(off));
  }
  found.start = time[first];
  found.start_error = first > 0 ? time[first] - time[first - 1] : 0;
  if (t.size() < 3) return;
  const auto rows = static_cast<Eigen::Index>(t.size());
  Eigen::MatrixXd columns(rows, 2);
  columns << Eigen::VectorXd::Ones(rows), Eigen::Map<Eigen::VectorXd>(t.data(), rows);
  const Eigen::VectorXd values = Eigen::Map<Eigen::VectorXd>(root.data(), rows);
  const Eigen::VectorXd line = least_squares_coefficients(columns, values);
  if (!(line[0] > 0 && line[1] > 0)) return;
  found.start = std::max(time.front(), time[first] - line[0] / line[1]);
  found.start_error = (values - columns * line).norm() / std::sqrt(static_cast<double>(rows)) / line[1];
}

/// Tells whether the box rests before it moves, and sets what that tells.
bool find_lead_in(const std::vector<double>& time, const std::vector<double>& x, const MotionSeen& motion,
                  double interval, double deviation, ReleaseFound& found) {
  constexpr double least_periods = 0.05;  // a box near a turning point seems to rest so long
  const double sure = std::max(surely_off * deviation, 1e-3 * motion.range);
  std::size_t end = std::min<std::size_t>(5, x.size());
  Level level;
  for (int pass = 0; pass < 3; ++pass) {
    level = level_of(x, 0, end, deviation);
    if (!std::isfinite(level.value)) return false;
    const std::size_t left = leaves(x, level, sure);
    if (left < fewest_at_rest || left >= x.size()) return false;
    end = left;
  }
  double off = 0;
  for (std::size_t i = 0; i < end; ++i) off += std::abs(x[i] - level.value) > sure;
  if (off > 0.1 * static_cast<double>(end)) return false;
  ReleaseFound rested = found;
  extrapolate_start(time, x, end, level, motion.range, rested);
  rested.lead_in = rested.start - time.front();
  const double period = std::isfinite(motion.period) ? motion.period : 1;
  if (rested.lead_in < std::max({3 * interval, 5 * rested.start_error, least_periods * period})) return false;
  rested.displacement = level.value, rested.displacement_error = level.error;
  rested.velocity = rested.velocity_error = 0;
  rested.time = rested.start, rested.time_error = rested.start_error;
  found = rested;
  return true;
}

/// Fits x = d + v t - a t^2 / 2 to the first moments; with few frames d + v sin(w t) / w + a (cos(w t) - 1) /
/// w^2 to a third of a period.
void fit_start(const std::vector<double>& time, const std::vector<double>& x, const MotionSeen& motion,
               double deviation, ReleaseFound& found) {
  const auto frames_until = [&](double end) {
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < x.size() && time[i] < end; ++i)
      if (std::isfinite(x[i])) frames.push_back(i);
    return frames;
  };
  const double start = time.front();
  const bool has_period = std::isfinite(motion.period);
  std::vector<std::size_t> frames =
      frames_until(start + std::min(first_moments, has_period ? motion.period / 12 : first_moments));
  const bool few = frames.size() < fewest;
  if (few && has_period) frames = frames_until(start + motion.period / 3);
  if (frames.size() < (few ? 4 : fewest) || (few && !has_period)) return;
  const double w = few ? 2 * std::numbers::pi / motion.period : 0;
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(frames.size()), 3);
  Eigen::VectorXd values(columns.rows());
  for (Eigen::Index row = 0; row < columns.rows(); ++row) {
    const std::size_t i = frames[static_cast<std::size_t>(row)];
    const double t = time[i] - start;
    columns(row, 0) = 1;
    columns(row, 1) = few ? std::sin(w * t) / w : t;
    columns(row, 2) = few ? (std::cos(w * t) - 1) / (w * w) : -t * t / 2;
    values[row] = x[i];
  }
  const Eigen::VectorXd length = columns.colwise().norm().transpose();
  const Eigen::MatrixXd scaled = columns * length.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd inverse = pseudo_inverse(scaled.transpose() * scaled);
  const Eigen::VectorXd fit = (inverse * (scaled.transpose() * values)).cwiseQuotient(length);
  found.displacement = fit[0];
  found.displacement_error = deviation * std::sqrt(inverse(0, 0)) / length[0];
  found.velocity = fit[1];
  found.velocity_error = deviation * std::sqrt(inverse(1, 1)) / length[1];
  if (fit[2] == 0) return;
  found.time = start + fit[1] / fit[2];
  found.time_error = found.velocity_error / std::abs(fit[2]);
}

/// Finds the middle of the swings: of three turns in a row it is (first + 2 second + third) / 4, whatever is
/// lost between them evenly.
void find_centre(const MotionSeen& motion, ReleaseFound& found) {
  std::vector<double> middles;
  for (std::size_t i = 0; i + 2 < motion.turns.size(); ++i)
    middles.push_back(
        (motion.turns[i].position + 2 * motion.turns[i + 1].position + motion.turns[i + 2].position) / 4);
  if (middles.empty()) return;
  found.centre = median(middles);
  found.centre_error = middles.size() < 3
                           ? 0.01 * motion.range
                           : robust_deviation(middles) / std::sqrt(static_cast<double>(middles.size()));
}

}  // namespace

ReleaseFound release_found(const std::vector<double>& time, const std::vector<double>& x,
                           const MotionSeen& motion, double interval, double deviation) {
  ReleaseFound found;
  found.displacement = found.displacement_error = found.velocity = found.velocity_error = nothing;
  found.time = found.time_error = found.centre = found.centre_error = found.rest = found.rest_error = nothing;
  if (time.empty()) return found;
  found.start = time.front(), found.start_error = interval;
  find_centre(motion, found);
  for (const RestStretch& stretch : rests_of(motion, std::max(8 * deviation, 0.01 * motion.range))) {
    if (stretch.first == 0) continue;
    const Level level = level_of(x, stretch.first, stretch.end, deviation);
    found.rest = level.value, found.rest_error = level.error;
  }
  if (!find_lead_in(time, x, motion, interval, deviation, found))
    fit_start(time, x, motion, deviation, found);
  return found;
}

}  // namespace shakedown
