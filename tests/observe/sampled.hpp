// SPDX-License-Identifier: MIT
#pragma once
#include <functional>

#include "trajectory.hpp"

/// A trajectory made from a formula, at `rate` Hz.
inline shakedown::Trajectory sampled(double duration, double rate,
                                     const std::function<double(double)>& position,
                                     const std::function<double(double)>& velocity) {
  shakedown::Trajectory trajectory;
  for (int k = 0; k <= static_cast<int>(duration * rate + 0.5); ++k) {
    const double time = k / rate;
    trajectory.time.push_back(time);
    trajectory.x_box.push_back(position(time));
    if (velocity) trajectory.v_box.push_back(velocity(time));
    trajectory.x_com.push_back(0);
  }
  return trajectory;
}
