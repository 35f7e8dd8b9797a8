// SPDX-License-Identifier: MIT
// Moves positions to times a little earlier or later than they were sampled. Each sample keeps its own noise:
// only the change within the shift is taken from a local cubic through the samples around it.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace shakedown {

/// How far a sample at `position` (m) is moved, s; must be small against the motion.
using Shift = std::function<double(double position)>;

/// A series' samples in time, fixed, with the weights of the local cubics around them. Samples whose position
/// is not finite take no part; the cubics reach over the nearest finite ones.
class LocalCubics {
 public:
  /// `longest_shift` (s) widens the cubics to four times itself, three samples at least, so that the inverse
  /// converges.
  LocalCubics(std::span<const double> time, std::span<const double> position, double longest_shift);

  /// Returns x(t + shift(x)) for each sample, m, where the series is x(t).
  std::vector<double> later(std::span<const double> position, const Shift& shift) const;
  /// Returns the series whose later() is `position`, m, to 1e-13 m where the fixed point converges so far.
  std::vector<double> earlier(std::span<const double> position, const Shift& shift) const;
  /// Returns the slope at each sample, m/s.
  std::vector<double> slope(std::span<const double> position) const;

 private:
  struct Piece {
    std::size_t first;    ///< in used_
    std::size_t weights;  ///< in weights_
  };
  /// Returns slope, half the second and a sixth of the third derivative of a piece: m/s, m/s^2, m/s^3.
  Eigen::Vector3d coefficients(const Piece& piece, std::span<const double> position) const;

  std::vector<std::size_t> used_;  ///< samples with a position
  std::vector<Piece> pieces_;      ///< one a used sample
  /// Of the used samples from Piece::first on: for slope, half the second and a sixth of the third
  /// derivative.
  std::vector<Eigen::Matrix3Xd> weights_;
};

}  // namespace shakedown
