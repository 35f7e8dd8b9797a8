// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "trajectory.hpp"

namespace shakedown {

/// What a measurement holds of a motion.
struct Recording {
  std::vector<double> time;   ///< s
  std::vector<double> x_box;  ///< m
  std::vector<double> x_com;  ///< m; NaN without grains
};

/// The trajectory as a camera sees it (Physics::Camera): first where the centre of the grains seems to be
/// (seen along the arc, drawn towards the middle of the box), then the scale of the picture, then its drift;
/// the clock is only shifted.
Recording recorded_by(const Camera& camera, const Trajectory& trajectory);

}  // namespace shakedown
