// SPDX-License-Identifier: MIT
// Reads the track of a bouncing ball: parabolas between impacts, whose common curvature is gravity in the
// table's units.
#pragma once
#include "table_layout.hpp"

namespace shakedown {

/// Finds the impacts of a track by the crossings of neighbouring parabolas. A fall from rest at the beginning
/// counts as a flight of twice its length. Throws InputError where fewer than three flights have four frames.
ReadDrops drops_of_track(const Table& table, const TrackColumns& columns, const DropReading& reading);

/// What the frames say, any units.
struct TrackImpacts {
  std::vector<double> instant;  ///< s
  double fall = not_said;       ///< s, from the highest point before the first impact to it
  double scale = 0;             ///< m, of one unit of height, from gravity
  double deviation = 0;         ///< of a frame from its parabola, in units of height
};
/// Finds them. `time`: s; `height`: in any unit, growing upwards or downwards; `gravity`: m/s^2.
TrackImpacts impacts_of_track(std::vector<double> time, std::vector<double> height, double gravity);

}  // namespace shakedown
