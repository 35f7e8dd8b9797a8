// SPDX-License-Identifier: MIT
#include "slow_wander.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shakedown {

namespace {

constexpr double block_time = 0.04;  // s, whose means hold what is below 25 Hz
constexpr std::size_t fewest_blocks = 20;
constexpr double seen_at = 4;  // standard errors

/// The means of the blocks of one stretch, m, less their mean and what still swings.
struct Blocks {
  Eigen::ArrayXd mean;
  double length = 0;  ///< s
};

/// Returns the values without their mean and a slowly changing swing of this angular frequency.
Eigen::VectorXd without_swing(const Eigen::ArrayXd& time, const Eigen::VectorXd& values, double frequency) {
  Eigen::MatrixXd columns(time.size(), 5);
  const Eigen::ArrayXd late = (time - time[0]) / (time[time.size() - 1] - time[0]);
  columns.col(0).setOnes();
  columns.col(1) = (frequency * time).cos(), columns.col(2) = (frequency * time).sin();
  columns.col(3) = late * columns.col(1).array(), columns.col(4) = late * columns.col(2).array();
  return values - columns * columns.householderQr().solve(values);
}

/// Takes out the mean, and of all swings of about the motion's period the one that explains most.
void take_out_swing(const Eigen::ArrayXd& time, double period, Eigen::ArrayXd& values) {
  values -= values.mean();
  const double duration = time[time.size() - 1] - time[0];
  if (!(duration > 3 * period)) return;
  const Eigen::VectorXd all = values.matrix();
  Eigen::VectorXd least = all;
  const double step = 0.25 / duration;
  for (double frequency = 0.6 / period; frequency < 1.6 / period; frequency += step)
    if (const Eigen::VectorXd left = without_swing(time, all, 2 * std::numbers::pi * frequency);
        left.squaredNorm() < least.squaredNorm())
      least = left;
  values = least.array();
}

Blocks blocks_of(const std::vector<double>& time, const std::vector<double>& x, const RestStretch& stretch,
                 double period) {
  const double frame =
      (time[stretch.end - 1] - time[stretch.first]) / static_cast<double>(stretch.end - stretch.first - 1);
  Blocks blocks;
  blocks.length = std::max(block_time, frame);
  const auto count = static_cast<std::size_t>((time[stretch.end - 1] - time[stretch.first]) / blocks.length);
  std::vector<double> sum(count, 0), number(count, 0);
  for (std::size_t i = stretch.first; i < stretch.end; ++i) {
    const auto block = static_cast<std::size_t>((time[i] - time[stretch.first]) / blocks.length);
    if (block < count && std::isfinite(x[i])) sum[block] += x[i], ++number[block];
  }
  std::vector<double> means, places;
  for (std::size_t block = 0; block < count; ++block)
    if (number[block] > 0)
      means.push_back(sum[block] / number[block]),
          places.push_back((static_cast<double>(block) + 0.5) * blocks.length);
  if (means.size() < fewest_blocks) return blocks;
  const auto size = static_cast<Eigen::Index>(means.size());
  blocks.mean = Eigen::Map<Eigen::ArrayXd>(means.data(), size);
  take_out_swing(Eigen::Map<Eigen::ArrayXd>(places.data(), size), period, blocks.mean);
  return blocks;
}

/// The autocovariances of the blocks up to a third of the shortest stretch, all stretches together.
struct Autocovariances {
  std::vector<double> at;  ///< m^2
  std::vector<double> pairs;
};
Autocovariances autocovariances(const std::vector<Blocks>& stretches) {
  Autocovariances found;
  Eigen::Index shortest = stretches.front().mean.size();
  for (const Blocks& one : stretches) shortest = std::min(shortest, one.mean.size());
  for (Eigen::Index lag = 0; lag < std::max<Eigen::Index>(4, shortest / 3); ++lag) {
    double sum = 0, pairs = 0;
    for (const Blocks& one : stretches) {
      const Eigen::Index n = one.mean.size() - lag;
      sum += (one.mean.head(n) * one.mean.tail(n)).sum(), pairs += static_cast<double>(n);
    }
    found.at.push_back(sum / pairs), found.pairs.push_back(pairs);
  }
  return found;
}

/// Returns the autocovariance of unit wander at each lag, less what is lost with the mean of a stretch.
std::vector<double> unit_wander(const Autocovariances& found, const std::vector<Blocks>& stretches,
                                double time) {
  const auto at = [&](double blocks) { return std::exp(-blocks * stretches.front().length / time); };
  double taken = 0, weight = 0;
  for (const Blocks& one : stretches) {
    const auto n = static_cast<double>(one.mean.size());
    double sum = n;
    for (double lag = 1; lag < n; ++lag) sum += 2 * (n - lag) * at(lag);
    taken += sum / n, weight += n;
  }
  std::vector<double> shape;
  for (std::size_t lag = 0; lag < found.at.size(); ++lag)
    shape.push_back(at(static_cast<double>(lag)) - taken / weight);
  return shape;
}

}  // namespace

std::vector<RestStretch> rests_of(const MotionSeen& motion, double still) {
  const auto moves = [&](double excursion) { return excursion > still; };
  const auto begin = motion.excursion.begin(), end = motion.excursion.end();
  const auto first = std::find_if(begin, end, moves);
  std::vector<RestStretch> rests;
  if (first == end) return rests;  // it never moves: what seems to rest may be anything
  const auto last = std::find_if(motion.excursion.rbegin(), motion.excursion.rend(), moves).base();
  if (first != begin) rests.push_back({0, static_cast<std::size_t>(first - begin)});
  if (last != end)
    rests.push_back({static_cast<std::size_t>(last - begin), static_cast<std::size_t>(end - begin)});
  return rests;
}

Wander wander_at_rest(const std::vector<double>& time, const std::vector<double>& x,
                      const std::vector<RestStretch>& rests, double period) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<Blocks> stretches;
  for (const RestStretch& rest : rests) {
    if (rest.end - rest.first < fewest_blocks) continue;
    Blocks blocks = blocks_of(time, x, rest, period);
    if (blocks.mean.size() > 0) stretches.push_back(std::move(blocks));
  }
  if (stretches.empty()) return {unknown, unknown};
  const Autocovariances found = autocovariances(stretches);
  // White blocks rarely make the first lags so large.
  const double error = found.at[0] / std::sqrt(found.pairs[0]);
  const double first_three = (found.at[1] + found.at[2] + found.at[3]) / std::sqrt(3.0);
  if (!(found.at[0] > 0) || first_three < seen_at * error) return {0, 0};
  Wander best;
  double least = std::numeric_limits<double>::infinity();
  const double longest = stretches.front().length * static_cast<double>(found.at.size());
  for (double memory = stretches.front().length; memory < longest; memory *= 1.1) {
    const std::vector<double> shape = unit_wander(found, stretches, memory);
    double product = 0, square = 0, misfit = 0;
    for (std::size_t lag = 1; lag < shape.size(); ++lag)
      product += found.pairs[lag] * shape[lag] * found.at[lag],
          square += found.pairs[lag] * shape[lag] * shape[lag];
    const double variance = std::max(0.0, product / square);
    for (std::size_t lag = 1; lag < shape.size(); ++lag)
      misfit += found.pairs[lag] * std::pow(found.at[lag] - variance * shape[lag], 2);
    if (misfit < least && variance > 0) least = misfit, best = {std::sqrt(variance), memory};
  }
  return best;
}

}  // namespace shakedown
