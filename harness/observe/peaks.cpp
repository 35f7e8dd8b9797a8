// SPDX-License-Identifier: MIT
#include "peaks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shakedown {

namespace {

std::vector<double> sign_changes(const SampledMotion& motion) {
  std::vector<double> times;
  if (motion.size() == 0) return times;
  if (motion.position[0] == 0) times.push_back(motion.time[0]);
  std::size_t before = 0;  // the last sample that was not exactly zero
  for (std::size_t i = 1; i < motion.size(); ++i) {
    if (motion.position[i] == 0) continue;
    if (motion.position[before] * motion.position[i] < 0) {
      const bool between = i == before + 1;
      const CubicPiece piece = piece_of(motion, before);
      times.push_back(between ? piece.time_at(zero_place(piece)) : motion.time[before + 1]);
    }
    before = i;
  }
  return times;
}

}  // namespace

std::vector<double> zero_crossings(const SampledMotion& motion, double shortest) {
  std::vector<double> kept;
  for (const double time : sign_changes(motion)) {
    if (!kept.empty() && time - kept.back() < shortest)
      kept.pop_back();
    else
      kept.push_back(time);
  }
  return kept;
}

std::vector<Peak> largest_extrema(const SampledMotion& motion, const std::vector<double>& crossings) {
  std::vector<Peak> peaks;
  for (std::size_t n = 0; n + 1 < crossings.size(); ++n) {
    const auto first = std::upper_bound(motion.time.begin(), motion.time.end(), crossings[n]);
    const auto last = std::lower_bound(motion.time.begin(), motion.time.end(), crossings[n + 1]);
    Peak peak;
    const auto offer = [&](double time, double position) {
      if (std::abs(position) > std::abs(peak.position)) peak = {time, position};
    };
    // Whole pieces only, but for the two that hold the crossings: their inner stationary points lie on this
    // side of zero or are smaller than the samples inside.
    const std::size_t begin = static_cast<std::size_t>(first - motion.time.begin());
    const std::size_t end = static_cast<std::size_t>(last - motion.time.begin());
    for (std::size_t i = begin; i < end; ++i) {
      offer(motion.time[i], motion.position[i]);
      if (i + 1 >= end) continue;
      const CubicPiece piece = piece_of(motion, i);
      for (const double u : stationary_places(piece)) offer(piece.time_at(u), piece.at(u));
    }
    if (peak.position != 0) peaks.push_back(peak);
  }
  return peaks;
}

double frequency_of(const std::vector<double>& crossings) {
  if (crossings.size() < 10) return std::numeric_limits<double>::quiet_NaN();
  return 4.5 / (crossings[9] - crossings[0]);
}

}  // namespace shakedown
