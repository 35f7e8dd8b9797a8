// SPDX-License-Identifier: MIT
#include "landings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "expect.hpp"

namespace shakedown {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The frames in which both tracks have a position.
struct Tracks {
  std::vector<double> time, centre, inside;  ///< s, m, m: of the grains in the laboratory and in the box
};

Tracks tracks_of(const std::vector<double>& time, const std::vector<double>& box,
                 const std::vector<double>& centre) {
  EXPECT(time.size() == box.size() && time.size() == centre.size());
  Tracks tracks;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (std::isfinite(box[i]) && std::isfinite(centre[i])) {
      tracks.time.push_back(time[i]);
      tracks.centre.push_back(centre[i]);
      tracks.inside.push_back(centre[i] - box[i]);
    }
  return tracks;
}

struct FrameRange {
  std::size_t begin, end;
};

FrameRange frames_between(const std::vector<double>& time, double from, double to) {
  const auto at = [&](double t) {
    return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), t) - time.begin());
  };
  return {at(from), at(to)};
}

/// Mean and slope of a straight line through the frames; NaN from fewer than five.
struct Line {
  double mean = none, slope = none;
};

Line line_through(const std::vector<double>& time, const std::vector<double>& place, FrameRange frames) {
  constexpr std::size_t fewest = 5;
  if (frames.end < frames.begin + fewest) return {};
  const double n = static_cast<double>(frames.end - frames.begin);
  double t = 0, x = 0, tt = 0, tx = 0;
  for (std::size_t i = frames.begin; i < frames.end; ++i) t += time[i] / n, x += place[i] / n;
  for (std::size_t i = frames.begin; i < frames.end; ++i) {
    tt += (time[i] - t) * (time[i] - t);
    tx += (time[i] - t) * (place[i] - x);
  }
  return {x, tx / tt};
}

/// Returns the times at which the layer passes through the middle of the box from one side to the other, s,
/// interpolated between frames.
std::vector<double> passages(const Tracks& tracks) {
  constexpr double reached = 0.3;  // of the farthest: less is a wiggle about the middle
  double farthest = 0;
  for (const double y : tracks.inside) farthest = std::max(farthest, std::abs(y));
  std::vector<double> found;
  double side = 0, crossed = none;
  for (std::size_t i = 1; i < tracks.inside.size(); ++i) {
    const double before = tracks.inside[i - 1], here = tracks.inside[i];
    if ((before < 0) != (here < 0))
      crossed =
          tracks.time[i] - (tracks.time[i] - tracks.time[i - 1]) * std::abs(here) / std::abs(here - before);
    if (std::abs(here) < reached * farthest || std::copysign(1, here) == side) continue;
    if (side != 0) found.push_back(crossed);
    side = std::copysign(1, here);
  }
  return found;
}

class OneLanding {
 public:
  /// Between two passages, in which the layer lies on the wall of this side.
  OneLanding(const Tracks& tracks, double from, double to, double window)
      : tracks_(tracks), window_(window), frames_(frames_between(tracks.time, from, to)) {
    side_ = std::copysign(1, line_through(tracks.time, tracks.inside, frames_).mean);
    for (std::size_t i = frames_.begin; i < frames_.end; ++i) speed_.push_back(speed_about(tracks.time[i]));
  }

  Landing seen(const LandingBox& of) const {
    Landing landing{none, none, none, none, none, none};
    const std::size_t fastest = fastest_frame();
    if (fastest == speed_.size()) return landing;
    landing.speed = speed_[fastest];
    const std::size_t half = first_below(0.5 * landing.speed, fastest),
                      landed = first_below(0.1 * landing.speed, fastest);
    if (landed == speed_.size()) return landing;
    landing.time = time_at(half);
    std::size_t begins = half;
    while (begins > fastest && !(speed_[begins] >= 0.9 * landing.speed)) --begins;
    landing.lasting = time_at(landed) - time_at(begins);
    const double after = time_at(landed);
    landing.rebound = -side_ * slope_between(after, after + window_) / landing.speed;
    const Line lying =
        line_through(tracks_.time, tracks_.inside, frames_between(tracks_.time, after, after + window_));
    landing.thickness = of.length - 2 * side_ * lying.mean;
    return landing;
  }
  double side() const { return side_; }

 private:
  double time_at(std::size_t k) const { return tracks_.time[frames_.begin + k]; }
  double slope_between(double from, double to) const {
    return line_through(tracks_.time, tracks_.inside, frames_between(tracks_.time, from, to)).slope;
  }
  /// Returns the speed towards the wall, m/s.
  double speed_about(double time) const {
    return side_ * slope_between(time - window_ / 2, time + window_ / 2);
  }
  /// Returns the frame of the greatest speed; speed_.size() where none moves towards the wall.
  std::size_t fastest_frame() const {
    std::size_t fastest = speed_.size();
    for (std::size_t k = 0; k < speed_.size(); ++k)
      if (speed_[k] > 0 && (fastest == speed_.size() || speed_[k] > speed_[fastest])) fastest = k;
    return fastest;
  }
  std::size_t first_below(double speed, std::size_t from) const {
    std::size_t k = from;
    while (k < speed_.size() && !(speed_[k] < speed)) ++k;
    return k;
  }

  const Tracks& tracks_;
  double window_;
  FrameRange frames_;
  double side_ = 0;
  std::vector<double> speed_;  // of each frame
};

}  // namespace

std::vector<Landing> landings(const std::vector<double>& time, const std::vector<double>& box,
                              const std::vector<double>& centre, const LandingBox& of) {
  const Tracks tracks = tracks_of(time, box, centre);
  const std::vector<double> passed = passages(tracks);
  const double window = landing_window * of.period;
  // Free flight: the grains' momentum in the laboratory stays.
  const auto in_flight = [&](double at) {
    return line_through(tracks.time, tracks.centre,
                        frames_between(tracks.time, at - window / 2, at + window / 2))
        .slope;
  };
  std::vector<Landing> found;
  for (std::size_t k = 0; k + 1 < passed.size(); ++k) {
    const OneLanding one(tracks, passed[k], passed[k + 1], window);
    found.push_back(one.seen(of));
    found.back().momentum = one.side() * of.grains_mass * (in_flight(passed[k]) - in_flight(passed[k + 1]));
  }
  return found;
}

}  // namespace shakedown
