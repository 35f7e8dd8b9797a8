// SPDX-License-Identifier: MIT
#include "frame_motion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <optional>

#include "least_squares.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

/// Half of a fit's window has this part of the period, as short as kinks ask where frames are many, and this
/// many frames at least, so that five lie within.
constexpr double window_periods = 1.0 / 16, window_frames = 2.6;

struct Frames {
  std::vector<double> time, x;
  double interval = 0;  ///< s, the usual one
};

Frames frames_of(const std::vector<double>& time, const std::vector<double>& x, double middle) {
  Frames frames;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i])) frames.time.push_back(time[i]), frames.x.push_back(x[i] - middle);
  if (frames.time.size() > 1) frames.interval = typical_interval(frames.time);
  return frames;
}

/// x = offset + even cos(w (t - about)) + odd sin(w (t - about)) through the frames near by.
struct LocalSwing {
  double about = 0, w = 0, offset = 0, even = 0, odd = 0;

  double at(double t) const {
    return offset + even * std::cos(w * (t - about)) + odd * std::sin(w * (t - about));
  }
  double slope(double t) const {
    return w * (odd * std::cos(w * (t - about)) - even * std::sin(w * (t - about)));
  }
};

/// Fits a swing of angular frequency w to the frames within `half` (s) of `about`; nothing where they lie on
/// one side only, or are too few.
std::optional<LocalSwing> local_swing(const Frames& frames, double about, double half, double w) {
  const auto first = std::lower_bound(frames.time.begin(), frames.time.end(), about - half);
  const auto last = std::upper_bound(first, frames.time.end(), about + half);
  const Eigen::Index count = last - first;
  if (count < 4 || *first > about - frames.interval / 4 || *(last - 1) < about + frames.interval / 4)
    return std::nullopt;
  Eigen::MatrixXd columns(count, 3);
  Eigen::VectorXd values(count);
  for (Eigen::Index row = 0; row < count; ++row) {
    const double phase = w * (*(first + row) - about);
    columns.row(row) << 1, std::cos(phase) - 1, std::sin(phase);
    values[row] = frames.x[static_cast<std::size_t>(first - frames.time.begin() + row)];
  }
  const Eigen::Vector3d fit = least_squares_coefficients(columns, values);
  return LocalSwing{about, w, fit[0] - fit[1], fit[1], fit[2]};
}

/// Returns the extremum of the given sign nearest to `about`; nothing where the frames show none there.
std::optional<Peak> extremum(const Frames& frames, double about, double sign, double half, double w) {
  std::optional<Peak> peak;
  for (int pass = 0; pass < 3; ++pass) {
    const std::optional<LocalSwing> swing = local_swing(frames, about, half, w);
    if (!swing) return peak;
    const double phase = std::atan2(sign * swing->odd, sign * swing->even);  // of the extremum of this sign
    if (std::abs(phase) > w * half) return peak;
    about += phase / w;
    peak = Peak{about, swing->at(about)};
  }
  return peak;
}

double crossing(const Frames& frames, double near, double half, double w) {
  double at = near;
  for (int pass = 0; pass < 3; ++pass) {
    const std::optional<LocalSwing> swing = local_swing(frames, at, half, w);
    if (!swing || swing->slope(at) == 0) return near;
    at -= swing->at(at) / swing->slope(at);
    if (!(std::abs(at - near) < half)) return near;
  }
  return at;
}

double usual_half_period(const std::vector<double>& crossings) {
  std::vector<double> halves;
  for (std::size_t i = 1; i < crossings.size(); ++i) halves.push_back(crossings[i] - crossings[i - 1]);
  if (halves.empty()) return std::numeric_limits<double>::quiet_NaN();
  return median(std::move(halves));
}

std::string too_few(double frames) {
  char text[96];
  std::snprintf(text, sizeof text, "%.1f frames a period are too few for peaks (%.0f are needed)", frames,
                least_frames_per_period);
  return text;
}

}  // namespace

FrameMotion frame_motion(const std::vector<double>& time, const std::vector<double>& x, double middle,
                         double shortest) {
  FrameMotion motion;
  motion.frequency = std::numeric_limits<double>::quiet_NaN();
  const Frames frames = frames_of(time, x, middle);
  const SampledMotion sampled{frames.time, frames.x, {}};
  std::vector<double> rough = zero_crossings(sampled, shortest);
  const double half_period = usual_half_period(rough);
  if (!std::isfinite(half_period)) {
    motion.why_not = "the box passes its middle less than twice";
    return motion;
  }
  // The crossings' own error may make the frames a period 2 % too few.
  const double in_a_period = 2 * half_period / frames.interval;
  if (in_a_period < 0.98 * least_frames_per_period) {
    motion.why_not = too_few(in_a_period);
    return motion;
  }
  const double w = std::numbers::pi / half_period,
               half = std::max(2 * window_periods * half_period, window_frames * frames.interval);
  for (const double near : rough) motion.crossings.push_back(crossing(frames, near, half, w));
  for (std::size_t n = 0; n + 1 < rough.size(); ++n) {
    const auto first =
        std::upper_bound(frames.time.begin(), frames.time.end(), rough[n]) - frames.time.begin();
    const auto last =
        std::lower_bound(frames.time.begin(), frames.time.end(), rough[n + 1]) - frames.time.begin();
    const auto farthest = std::max_element(frames.x.begin() + first, frames.x.begin() + last,
                                           [](double a, double b) { return std::abs(a) < std::abs(b); });
    if (farthest == frames.x.begin() + last) continue;
    const double about = frames.time[static_cast<std::size_t>(farthest - frames.x.begin())];
    if (const auto peak = extremum(frames, about, std::copysign(1.0, *farthest), half, w))
      motion.peaks.push_back(*peak);
  }
  motion.frequency = frequency_of(motion.crossings);
  if (motion.peaks.empty()) motion.why_not = "no half period has frames on both sides of its peak";
  return motion;
}

}  // namespace shakedown
