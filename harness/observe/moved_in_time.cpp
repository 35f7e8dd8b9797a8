// SPDX-License-Identifier: MIT
#include "moved_in_time.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "least_squares.hpp"

namespace shakedown {

namespace {

constexpr std::size_t least_half_width =
    3;                                // samples; a cubic through seven halves the noise of five's slope
constexpr double width_of_shift = 4;  // shifts; the fixed point then contracts by 0.62 at worst (eigenvalues)
constexpr int most_rounds = 200;      // 0.62^200 is nothing

std::size_t half_width(std::span<const double> time, double longest_shift) {
  if (time.size() < 2) return least_half_width;
  const double interval = (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  return std::max(least_half_width,
                  static_cast<std::size_t>(std::ceil(width_of_shift * longest_shift / interval)));
}

enum class Solve { by_rotations, by_normal_equations };

/// Returns the weights for the coefficients of a least-squares cubic in `time` but its constant. The normal
/// equations are ten times as fast; the powers of a time within +-1 have a condition of some hundreds at
/// worst, and its square costs five digits of sixteen.
Eigen::Matrix3Xd cubic_weights(const Eigen::ArrayXd& time, Solve way) {
  const Eigen::Index n = time.size(), terms = std::min<Eigen::Index>(4, n);
  const double reach = std::max(time.abs().maxCoeff(), 1e-300);
  Eigen::MatrixXd powers = Eigen::MatrixXd::Ones(n, terms);
  for (Eigen::Index power = 1; power < terms; ++power)
    powers.col(power) = (powers.col(power - 1).array() * time / reach).matrix();
  Eigen::MatrixXd fit;
  if (way == Solve::by_rotations) {
    fit = least_squares_weights(powers);
  } else {
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;
    const Small squares = powers.transpose() * powers;
    fit = squares.ldlt().solve(powers.transpose());
  }
  Eigen::Matrix3Xd weights = Eigen::Matrix3Xd::Zero(3, n);
  for (Eigen::Index power = 1; power < terms; ++power)
    weights.row(power - 1) = fit.row(power) / std::pow(reach, static_cast<double>(power));
  return weights;
}

}  // namespace

LocalCubics::LocalCubics(std::span<const double> time, std::span<const double> position,
                         double longest_shift) {
  for (std::size_t i = 0; i < position.size(); ++i)
    if (std::isfinite(position[i])) used_.push_back(i);
  const std::size_t half = half_width(time, longest_shift), count = std::min(2 * half + 1, used_.size());
  Eigen::ArrayXd around(static_cast<Eigen::Index>(count));
  // A clock that is even, but for its rounding and for frames left out, has few patterns of neighbours. Times
  // within a thousandth of the interval count as one pattern: of a slope of 1 m/s that is 1e-4 m/s.
  constexpr double alike = 1e-3;
  const double interval =
      time.size() < 2 ? 1 : (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  // Of an uneven clock each is its own: none is looked for, and ten thousands are solved for.
  constexpr std::size_t most_patterns = 256;
  std::map<std::vector<std::int64_t>, std::size_t> patterns;
  std::vector<std::int64_t> pattern(count);
  for (std::size_t i = 0; i < used_.size(); ++i) {
    const std::size_t first = std::min(i > half ? i - half : 0, used_.size() - count);
    const double at = time[used_[i]];
    for (std::size_t j = 0; j < count; ++j) {
      const double apart = time[used_[first + j]] - at;
      around[static_cast<Eigen::Index>(j)] = apart;
      pattern[j] = std::llround(apart / (alike * interval));
    }
    std::size_t which = weights_.size();
    const bool looked_for = patterns.size() < most_patterns;
    if (looked_for) which = patterns.try_emplace(pattern, which).first->second;
    if (which == weights_.size())
      weights_.push_back(
          cubic_weights(around, looked_for ? Solve::by_rotations : Solve::by_normal_equations));
    pieces_.push_back({first, which});
  }
}

Eigen::Vector3d LocalCubics::coefficients(const Piece& piece, std::span<const double> position) const {
  const Eigen::Matrix3Xd& weights = weights_[piece.weights];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index j = 0; j < weights.cols(); ++j)
    sum += weights.col(j) * position[used_[piece.first + static_cast<std::size_t>(j)]];
  return sum;
}

std::vector<double> LocalCubics::later(std::span<const double> position, const Shift& shift) const {
  std::vector<double> moved(position.begin(), position.end());
  for (std::size_t i = 0; i < used_.size(); ++i) {
    const Eigen::Vector3d cubic = coefficients(pieces_[i], position);
    double& here = moved[used_[i]];
    const double start = here;
    for (int round = 0; round < 4; ++round) {  // each gains v shift'(x), a factor of hundreds
      const double dt = shift(here);
      here = start + dt * (cubic[0] + dt * (cubic[1] + dt * cubic[2]));
    }
  }
  return moved;
}

std::vector<double> LocalCubics::earlier(std::span<const double> position, const Shift& shift) const {
  std::vector<double> truth(position.begin(), position.end());
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<double> seen = later(truth, shift);
    double change = 0;
    for (const std::size_t i : used_) {
      const double miss = position[i] - seen[i];
      truth[i] += miss;
      change = std::max(change, std::abs(miss));
    }
    if (change < 1e-13) break;
  }
  return truth;
}

std::vector<double> LocalCubics::slope(std::span<const double> position) const {
  std::vector<double> slopes(position.begin(), position.end());  // NaN stays
  for (std::size_t i = 0; i < used_.size(); ++i) slopes[used_[i]] = coefficients(pieces_[i], position)[0];
  return slopes;
}

}  // namespace shakedown
