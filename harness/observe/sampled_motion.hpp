// SPDX-License-Identifier: MIT
#pragma once
#include <span>
#include <vector>

namespace shakedown {

/// A position sampled in time, joined by cubic Hermite pieces. Of an oscillation of amplitude A and angular
/// frequency w sampled every h the pieces are off by at most A (w h)^4 / 384: 2e-11 m for the paper's damper
/// at 500 Hz. A kick between two samples costs more, at most h/4 times the change of velocity. A view: the
/// samples must outlive it.
struct SampledMotion {
  std::span<const double> time;      ///< s, increasing, not necessarily evenly
  std::span<const double> position;  ///< m
  std::span<const double> velocity;  ///< m/s; empty: taken from a parabola through three positions

  std::size_t size() const { return time.size(); }  ///< number of samples
};

/// One cubic piece between two samples, in u = 0..1.
struct CubicPiece {
  double start = 0, length = 0;           ///< s
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;  ///< position = c0 + c1 u + c2 u^2 + c3 u^3, m

  /// Return value and time at u of 0 (its beginning) to 1 (its end); SI.
  double at(double u) const { return c0 + u * (c1 + u * (c2 + u * c3)); }
  double time_at(double u) const { return start + u * length; }
};

/// Returns the piece from sample i to sample i + 1.
CubicPiece piece_of(const SampledMotion& motion, std::size_t i);

/// Returns the places u strictly inside (0, 1) where the piece is stationary; at most two.
std::vector<double> stationary_places(const CubicPiece& piece);

/// Returns a place u where the piece is zero, given that its ends have opposite signs.
double zero_place(const CubicPiece& piece);

}  // namespace shakedown
