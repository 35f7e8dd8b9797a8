// SPDX-License-Identifier: MIT
#include "film.hpp"

#include <algorithm>
#include <cmath>

#include "sampled_motion.hpp"

namespace shakedown {

namespace {

/// Returns the position at any instant, s since release.
double position_at(const SampledMotion& motion, double instant) {
  if (instant <= motion.time.front() || motion.size() < 2) return motion.position.front();
  const auto after = std::upper_bound(motion.time.begin(), motion.time.end(), instant);
  const auto next = static_cast<std::size_t>(after - motion.time.begin());
  const std::size_t i = std::min(next, motion.size() - 1) - 1;
  const CubicPiece piece = piece_of(motion, i);
  return piece.at((instant - piece.start) / piece.length);
}

/// Returns where the reader of the rows meets the thing. The reader is a hundred times faster than the thing,
/// so that each round gains two digits.
double met_by_reader(const SampledMotion& motion, double start_of_frame, double seconds_a_metre) {
  double place = position_at(motion, start_of_frame);
  if (seconds_a_metre == 0 || std::isnan(place)) return place;
  for (int round = 0; round < 10; ++round)
    place = position_at(motion, start_of_frame + seconds_a_metre * place);
  return place;
}

/// Returns what the table says of a place: by a tilted pinhole with a third-order lens, then by what was
/// taken for a metre, a metre's zero and its drift.
double on_the_table(const Camera& errors, double place, double clock) {
  const double in_reaches = place / camera_lens_reach;
  const double of_tilt = errors.tilt * place * place / camera_lens_reach;
  const double image = place + of_tilt + errors.lens * place * in_reaches * in_reaches;
  return image * (1 + errors.scale) + (errors.origin + errors.drift * clock);
}

/// Returns the centre that is seen: the tilted box shortens the distance, the tracker loses a part of it, and
/// the depth enlarges what remains.
double seen_centre(const Camera& errors, double box, double centre) {
  const double tilt = errors.arc_length > 0 ? 1.5 * box / errors.arc_length : 0;
  const double distance = (centre - box) * std::cos(tilt);
  return (box + distance - errors.centre_bias * distance) * (1 + errors.depth);
}

}  // namespace

Frames even_frames(double rate, double late, double end) {
  Frames frames;
  for (std::size_t k = 0;; ++k) {
    const double stamp = static_cast<double>(k) / rate;
    if (stamp + late > end * (1 + 1e-12)) return frames;
    frames.instant.push_back(stamp + late);
    frames.stamp.push_back(stamp);
  }
}

Frames edge_frames(double edge, double start, const Trajectory& motion) {
  const SampledMotion box{motion.time, motion.x_box, motion.v_box};
  Frames frames;
  for (std::size_t i = 0; i + 1 < motion.time.size(); ++i) {
    const double from = motion.x_box[i] / edge, to = motion.x_box[i + 1] / edge;
    // Collect the edges between the two samples, in the order in which they are passed.
    std::vector<double> passed;
    for (double k = std::ceil(std::min(from, to)); k < std::max(from, to); ++k) passed.push_back(k * edge);
    if (to < from) std::reverse(passed.begin(), passed.end());
    for (const double place : passed) {
      double low = motion.time[i], high = motion.time[i + 1];
      for (int round = 0; round < 40; ++round) {
        const double middle = (low + high) / 2;
        ((position_at(box, middle) < place) == (from < to) ? low : high) = middle;
      }
      if (low < start) continue;
      frames.instant.push_back(low);
      frames.stamp.push_back(low - start);
    }
  }
  return frames;
}

Recording filmed(const Camera& errors, const Frames& frames, const Trajectory& motion) {
  const SampledMotion box{motion.time, motion.x_box, motion.v_box}, centre{motion.time, motion.x_com, {}};
  const double rows = errors.shutter / camera_track;
  Recording film;
  for (std::size_t k = 0; k < frames.instant.size(); ++k) {
    const double instant = frames.instant[k], at = met_by_reader(box, instant, rows);
    const double of_grains = seen_centre(errors, at, met_by_reader(centre, instant, rows));
    film.time.push_back(frames.stamp[k] + errors.time_offset);
    film.x_box.push_back(on_the_table(errors, at, instant));
    film.x_com.push_back(on_the_table(errors, of_grains, instant));
  }
  return film;
}

}  // namespace shakedown
